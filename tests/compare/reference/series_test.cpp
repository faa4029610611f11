#include "compare/reference/series.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

const std::string header =
    "# label: A\n# citation: B 1952\n# column: 2L high\n# column_height: 2\n# tank_width: 4\n"
    "# bed_depth: 0\n# gate: none\n# axes: T, Z/L\n# kind: experiment\n"
    "# time_uncertainty: 0.1\n# position_uncertainty: 0.15\n";

struct Published {
  const char* name;
  std::size_t points;
  bool experiment;
  double last_time;
  double last_position;
};

class PublishedFiles : public ::testing::TestWithParam<Published> {};

TEST_P(PublishedFiles, AreComplete) {
  const Published expected = GetParam();
  const PublishedSeries series =
      read_series(tests::sources() + "/compare/reference/" + expected.name + ".csv");
  EXPECT_EQ(series.name, expected.name);
  ASSERT_EQ(series.front.samples.size(), expected.points);
  EXPECT_DOUBLE_EQ(series.front.samples.back().time.value(), expected.last_time);
  EXPECT_DOUBLE_EQ(series.front.samples.back().position.value(), expected.last_position);
  EXPECT_EQ(series.experiment, expected.experiment);
  EXPECT_DOUBLE_EQ(series.time_uncertainty.value(), expected.experiment ? 0.1 : 0.0);
  EXPECT_DOUBLE_EQ(series.position_uncertainty.value(), expected.experiment ? 0.15 : 0.0);
  EXPECT_THAT(series.citation, HasSubstr("19"));
}

INSTANTIATE_TEST_SUITE_P(
    All, PublishedFiles,
    ::testing::Values(Published{"martin_moyce_1952_2.25in", 15, true, 3.33, 4.11},
                      Published{"martin_moyce_1952_1.125in", 6, true, 2.894, 3.675},
                      Published{"koshizuka_oka_1996_experiment", 9, true, 3.0912, 3.623},
                      Published{"koshizuka_oka_1996_mps", 9, false, 2.943, 3.997}));

struct Bad {
  std::string text;
  std::string message;
};

class BadSeries : public ::testing::TestWithParam<Bad> {};

TEST_P(BadSeries, IsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const auto file = write_text(folder / "s.csv", GetParam().text);
  EXPECT_THAT(error_of([&] { (void)read_series(file); }), HasSubstr("s.csv:" + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadSeries,
    ::testing::Values(
        Bad{header + "T,Z_over_L\n0,1\n1,x\n", "14: Z_over_L: \"x\" found"},
        Bad{header + "T,Z_over_L\n0,1\n1,nan\n", "14: Z_over_L: \"nan\" found"},
        Bad{header + "T,Z_over_L\n0,1\n1,2,3\n", "14: row: "},
        Bad{header + "T,Z_over_L\n0,1\n1\n", "14: row: "},
        Bad{header + "T,Z_over_L\n1,1\n1,2\n", "14: T: 1 found, a later time expected"},
        Bad{header + "T,Z_over_L\n1,1\n", "13: rows: 1 found"},
        Bad{header + "t,x\n1,1\n", "12: column names: "},
        Bad{header + "# colour: red\nT,Z_over_L\n0,1\n1,2\n", "15: colour: an unknown key"},
        Bad{header + "# label: again\nT,Z_over_L\n0,1\n1,2\n", "12: label: a second line"},
        Bad{"# label: A\nT,Z_over_L\n0,1\n1,2\n", "4: header: no \"# citation:\""},
        Bad{header + "# more: 1\nT,Z_over_L\n0,1\n1,2\n", "15: more: an unknown key"},
        Bad{header + "# note:\nT,Z_over_L\n0,1\n1,2\n", "12: note: nothing found"}));

TEST(Series, MissingFileIsNamed) {
  EXPECT_THAT(error_of([] { (void)read_series("/nowhere/a.csv"); }),
              HasSubstr("/nowhere/a.csv: found no such file"));
}

TEST(Series, StatesItsCase) {
  const PublishedSeries series =
      read_series(tests::sources() + "/compare/reference/koshizuka_oka_1996_experiment.csv");
  EXPECT_EQ(series.of.column_height, 2.0);
  EXPECT_EQ(series.of.tank_width, 4.0);
  EXPECT_EQ(series.of.bed_depth, 0.0);
  EXPECT_FALSE(series.of.gate.empty());
  EXPECT_FALSE(read_series(tests::sources() + "/compare/reference/martin_moyce_1952_2.25in.csv")
                   .of.tank_width);
}

TEST(Series, IsOfTheDamBreakOnly) {
  PublishedSeries series;
  series.of.column_height = 2.0;
  series.of.tank_width = 4.0;
  const Physics physics = testing::dam_break();
  EXPECT_FALSE(other_case(series, physics));
  const auto reason = [&](const std::function<void(Physics&)>& change) {
    Physics other = physics;
    change(other);
    return other_case(series, other).value_or("the same");
  };
  EXPECT_THAT(reason([](Physics& p) { p.column.upper[1] = 0.145; }),
              HasSubstr("height of the column: 2.00 L in the series, 1.00 L in the run"));
  EXPECT_THAT(reason([](Physics& p) { p.column.upper[1] = std::nan(""); }),
              HasSubstr("not stated"));
  EXPECT_THAT(reason([](Physics& p) { p.tank->upper[0] = 0.725; }),
              HasSubstr("far wall: 4.00 L in the series, 5.00 L in the run"));
  EXPECT_THAT(reason([](Physics& p) { p.tank.reset(); }), HasSubstr("far wall"));
  EXPECT_THAT(reason([](Physics& p) { p.obstacles->push_back({}); }), HasSubstr("obstacles"));
  EXPECT_THAT(reason([](Physics& p) {
                p.blocks->push_back({"box", {{0.3, 0, 0}, {0.4, 0.1, 0}}, {}});
              }),
              HasSubstr("bodies of water: 1 in the series, 2 in the run"));
  EXPECT_THAT(reason([](Physics& p) {
                p.blocks->push_back({"box", {{0.145, 0, 0}, {0.58, 0.029, 0}}, {}});
              }),
              HasSubstr("water in the tank: 0.00 L in the series, 0.20 L in the run"));
  EXPECT_THAT(reason([](Physics& p) {
                p.blocks->front().velocity = {1, 0, 0};
              }),
              HasSubstr("water at the start: at rest"));
  // Without a wall of its own a series belongs to any tank that is wide enough for its window.
  series.of.tank_width.reset();
  EXPECT_EQ(reason([](Physics& p) { p.tank->upper[0] = 0.725; }), "the same");
}

TEST(Series, NegativeUncertaintyIsRefused) {
  const TemporaryFolder folder;
  std::string text = header + "T,Z_over_L\n0,1\n1,2\n";
  text.replace(text.find("0.15"), 4, "-1");
  const auto file = write_text(folder / "s.csv", text);
  EXPECT_THAT(error_of([&] { (void)read_series(file); }), HasSubstr("position_uncertainty: -1"));
}

}  // namespace
}  // namespace surge::compare
