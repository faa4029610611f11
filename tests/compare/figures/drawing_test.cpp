#include <gmock/gmock.h>

#include <regex>

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

Figure figure_of_script(const std::string& name, const std::string& script) {
  Figure figure;
  figure.name = name;
  figure.script = script;
  return figure;
}

TEST(Drawing, PlottedRowsAreThoseThatBeginSo) {
  Table table{"t", {"name", "kind", "x", "y"}, {}};
  for (const double time : {1.0, 2.0})
    for (const double x : {0.0, 1.0, 2.0}) table.add({"a, c", time, x, 10.0 * time + x});
  table.add({"d", 1.0, 5.0, 15.0});
  table.add({"a, c", 1.0, 9.0, 19.0});  // not beside the others
  const TemporaryFolder folder;
  const auto plotted = [&](const std::vector<Table::Cell>& key) {
    const std::string rows = plotted_rows(table, key);
    if (rows.empty()) return std::string();
    Figure figure =
        figure_of_script("f", "set table \"seen.txt\"\nset format \"%g\"\nplot " + rows +
                                  " using 3:4 with points\nunset table\n"
                                  "plot [0:1] x notitle\n");
    figure.tables.push_back(table);
    (void)draw(figure, folder.path());
    std::istringstream seen(testing::read_text(folder / "seen.txt"));
    std::string line, points;
    while (std::getline(seen, line))
      if (!line.empty() && line[0] != '#')
        points += line.substr(0, line.find('i')) + ";";  // i: inside the range
    return std::regex_replace(points, std::regex(" +"), " ");
  };
  EXPECT_EQ(plotted({"a, c", 1.0}), "0 10 ;1 11 ;2 12 ;");
  EXPECT_EQ(plotted({"a, c", 2.0}), "0 20 ;1 21 ;2 22 ;");
  EXPECT_EQ(plotted({"d"}), "5 15 ;");
  EXPECT_EQ(plotted({"none"}), "");
}

TEST(Drawing, SeveralFiguresHaveTheirWarningsInTheirOrder) {
  const TemporaryFolder folder;
  std::vector<Figure> figures;
  for (int k = 0; k < 8; ++k)
    figures.push_back(figure_of_script(
        "f" + std::to_string(k),
        k % 2 == 0 ? "plot [0:1] x notitle"
                   : "print \"said by " + std::to_string(k) + "\"\nplot [0:1] x notitle"));
  figures[2].missing = "nothing to draw";
  const std::vector<std::string> said = draw_all(figures, folder.path());
  ASSERT_EQ(said.size(), figures.size());
  for (std::size_t k = 0; k < said.size(); ++k) {
    const std::string stem = "f" + std::to_string(k);
    for (const char* kind : {".gp", ".svg", ".pdf"})
      EXPECT_EQ(std::filesystem::exists(folder / (stem + kind)), k != 2) << stem << kind;
    if (k % 2 == 1)
      EXPECT_THAT(said[k], HasSubstr("said by " + std::to_string(k)));
    else
      EXPECT_EQ(said[k], "");
  }
  // The others are drawn before the one that fails is told.
  figures[5].script = "no command of gnuplot";
  std::filesystem::remove(folder / "f7.svg");
  EXPECT_THAT(testing::refusal_of([&] { (void)draw_all(figures, folder.path()); }),
              HasSubstr("f5.gp: gnuplot failed"));
  EXPECT_TRUE(std::filesystem::exists(folder / "f7.svg"));
}

}  // namespace
}  // namespace surge::compare
