#include <gmock/gmock.h>

#include "compare/figures/gnuplot.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

/// What a file may say to make a command language run it.
const std::vector<std::string> hostile{"`touch pwned`",
                                       "\"; system(\"touch pwned\"); \"",
                                       "\\\"; !touch pwned\n!touch pwned",
                                       "$(touch pwned)",
                                       "'; system('touch pwned'); '",
                                       "@pwned \x1b[31m\x07",
                                       "x\" at 1,1\n!touch pwned",
                                       "{/=20 `touch pwned`}"};

TEST(Drawing, TextsAreNeverCommands) {
  for (const std::string& text : hostile) {
    const TemporaryFolder folder;
    Figure figure;
    figure.name = "f";
    figure.title = text;
    Table table{"t", {"x", "y", text}, {}};
    table.add({0.0, 1.0, text});
    table.add({1.0, 2.0, text});
    figure.tables.push_back(table);
    figure.script = "set label 1 " + plot_label(text) + " at 0.5,1.5\nset title " +
                    plot_string(text) + " noenhanced\nplot \"t.csv\" using 1:2 with lines title " +
                    plot_string(text) + ", \"t.csv\" using (strcol(3) eq " + plot_string(text) +
                    " ? column(1) : NaN):2 with points notitle\n";
    (void)testing::refusal_of([&] { (void)draw(figure, folder.path()); });
    EXPECT_FALSE(std::filesystem::exists(folder / "pwned")) << text;
    EXPECT_THAT(testing::read_text(folder / "f.gp"), Not(HasSubstr("\x1b"))) << text;
  }
}

}  // namespace
}  // namespace surge::compare
