#include "compare/study.hpp"

#include <gmock/gmock.h>

#include "synthetic.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;

const std::string good = R"(title = "Dam break"
reference = "vof-20"
strip_height = 0.015
snapshot_times = [0.1, 0.2]
published = ["martin_moyce_1952_2.25in"]

[[run]]
name = "mps-paper-0.005"
program = "surge-particle"
case = "particle/cases/dam_break.toml"
set = ["method.name=mps", "resolution.spacing=0.005"]
threads = 2

[[run]]
name = "vof-20"
program = "interFoam"
case = "foam_cases/damBreak2D"
)";

Study read(std::string text, const std::string& what = "", const std::string& with = "") {
  const testing::TemporaryFolder folder;
  if (!what.empty()) text.replace(text.find(what), what.size(), with);
  return read_study(testing::write_text(folder / "study.toml", text));
}

TEST(Study, IsRead) {
  const Study study = read(good);
  EXPECT_EQ(study.title, "Dam break");
  EXPECT_EQ(study.reference, "vof-20");
  EXPECT_EQ(study.strip_height, Metres(0.015));
  EXPECT_EQ(study.snapshot_times, (std::vector{Seconds(0.1), Seconds(0.2)}));
  ASSERT_EQ(study.runs.size(), 2U);
  EXPECT_EQ(study.runs[0].settings.size(), 2U);
  EXPECT_EQ(study.runs[0].threads, 2);
  EXPECT_EQ(study.runs[1].program, "interFoam");
  EXPECT_EQ(study.runs[1].threads, 1);
}

TEST(Study, BadEntriesAreNamedWithTheirLine) {
  const auto refused = [](const std::string& what, const std::string& with) {
    return error_of([&] { (void)read(good, what, with); });
  };
  EXPECT_THAT(refused("strip_height = 0.015", "strip_height = -1.0"),
              HasSubstr("study.toml:3: strip_height"));
  EXPECT_THAT(refused("strip_height = 0.015\n", ""), HasSubstr("strip_height"));
  EXPECT_THAT(refused("title", "titel = \"\"\ntitle"), HasSubstr("titel"));
  EXPECT_THAT(refused("\"vof-20\"\nstrip", "\"vof-40\"\nstrip"),
              HasSubstr("study.toml:2: reference"));
  EXPECT_THAT(refused("\"interFoam\"", "\"fluent\""), HasSubstr("program"));
  EXPECT_THAT(refused("[0.1, 0.2]", "[0.2, 0.1]"), HasSubstr("snapshot_times"));
  EXPECT_THAT(refused("name = \"vof-20\"", "name = \"mps-paper-0.005\""), HasSubstr("second time"));
  EXPECT_THAT(refused("\"mps-paper-0.005\"", "\"../mps\""), HasSubstr("name"));
  EXPECT_THAT(refused("\"method.name=mps\"", "\"method.name\""), HasSubstr("key=value"));
  EXPECT_THAT(refused("threads = 2", "threads = 0"), HasSubstr("threads"));
  EXPECT_THAT(refused("threads = 2", "thread = 2"), HasSubstr("thread"));
}

}  // namespace
}  // namespace surge::compare
