#include "compare/reference/reference_series.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::dam_break;
using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

const std::vector<std::string> kinds{"gauge", "pressure", "profile"};

const std::string case_text =
    "title = \"c\"\ndimension = 2\n[fluid]\ndensity = 1000.0\ngravity = [0.0, -9.81]\n"
    "[tank]\nlower = [0.0, 0.0]\nupper = [0.58, 1.16]\nopen = [\"y+\"]\n"
    "[[block]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.145, 0.29]\n"
    "[[gauge]]\nname = \"g1\"\nposition = [0.29, 0.0]\n"
    "[resolution]\nspacing = 0.0145\n[time]\nend = 1.0\n[output]\ninterval = 0.1\n";

const std::string header =
    "# label: A\n# citation: B 1952\n# case: c\n# observable: gauge\n# name: g1\n# axes: t, h\n"
    "# time_unit: sqrt(H/g)\n# value_unit: H\n# kind: experiment\n# time_uncertainty: 0.1\n"
    "# value_uncertainty: 0.02\n# gate: none\n";

struct Written {
  TemporaryFolder folder;
  ReferenceSeries read(const std::string& text) const {
    write_text(folder / "c.toml", case_text);
    return read_reference(write_text(folder / "s.csv", text), kinds);
  }
};

Physics mirrored() {
  Physics run = dam_break();
  run.column = {{0.435, 0, 0}, {0.58, 0.29, 0}};
  run.blocks = {WaterBody{"box", run.column, {}}};
  return run;
}

TEST(ReferenceSeries, GivesSiValuesInTheRunsOwnScale) {
  const ReferenceSeries series = Written().read(header + "t,value\n0,0\n1,0.5\n");
  const ReferenceCurve curve = curve_for(series, dam_break(), "m");
  EXPECT_DOUBLE_EQ(curve.first[1], std::sqrt(0.29 / 9.81));
  EXPECT_DOUBLE_EQ(curve.value[1], 0.145);
  EXPECT_DOUBLE_EQ(curve.limit[1], 0.02 * 0.29);
  EXPECT_DOUBLE_EQ(curve.first_limit, 0.1 * std::sqrt(0.29 / 9.81));
  EXPECT_THAT(error_of([&] { (void)curve_for(series, dam_break(), "Pa"); }),
              HasSubstr("value_unit: found \"H\" in m, expected"));
}

TEST(ReferenceSeries, BelongsToItsCaseAndToItsMirror) {
  const ReferenceSeries series = Written().read(header + "t,value\n0,0\n1,0.5\n");
  EXPECT_FALSE(other_case(series, dam_break()));
  EXPECT_FALSE(other_case(series, mirrored()));
  Physics wider = dam_break();
  wider.tank->upper[0] = 0.725;
  EXPECT_THAT(other_case(series, wider).value_or(""), HasSubstr("far wall: 4.00 L in the series"));
  Physics blocked = dam_break();
  blocked.obstacles = {Extent{{0.3, 0, 0}, {0.35, 0.1, 0}}};
  EXPECT_THAT(other_case(series, blocked).value_or(""), HasSubstr("obstacles: 0"));
  Physics shaken = dam_break();
  shaken.motion = nlohmann::json{{"kind", "translation"}};
  EXPECT_THAT(other_case(series, shaken).value_or(""), HasSubstr("motion of the tank: none"));
  // In dimensionless numbers any size is the same case, in metres it is not.
  Physics twice = dam_break();
  twice.column.upper = {0.29, 0.58, 0};
  twice.tank->upper = {1.16, 2.32, 0};
  twice.blocks = {WaterBody{"box", twice.column, {}}};
  EXPECT_FALSE(other_case(series, twice));
  std::string in_metres = header;
  in_metres.replace(in_metres.find("sqrt(H/g)"), 9, "s");
  in_metres.replace(in_metres.find("value_unit: H"), 13, "value_unit: m");
  EXPECT_THAT(other_case(Written().read(in_metres + "t,value\n0,0\n1,0.5\n"), twice).value_or(""),
              HasSubstr("width of the column"));
}

TEST(ReferenceSeries, HoldsThePlaceToThatOfItsCase) {
  const ReferenceSeries series = Written().read(header + "t,value\n0,0\n1,0.5\n");
  EXPECT_FALSE(other_place(series, dam_break(), Vec3{0.29, 0, 0}, 0.0));
  EXPECT_FALSE(other_place(series, mirrored(), Vec3{0.58 - 0.29, 0, 0}, 0.0));
  EXPECT_THAT(other_place(series, dam_break(), Vec3{0.4, 0, 0}, 0.0).value_or(""),
              HasSubstr("place along the surge: 2.00 L in the series, 2.76 L in the run"));
}

TEST(ReferenceSeries, ProfilesTurnRoundWithTheCase) {
  std::string text = header;
  text.replace(text.find("observable: gauge\n# name: g1"), 28, "observable: profile");
  text.replace(text.find("# time_unit: sqrt(H/g)"), 22, "# at_time: 0.1*s\n# position_unit: cm");
  text.replace(text.find("time_uncertainty"), 16, "position_uncertainty");
  const std::string limit = "# value_uncertainty: 0.02\n";  // the column u says it
  text.erase(text.find(limit), limit.size());
  const ReferenceSeries series = Written().read(text + "x,value,u\n0,1,0.1\n14.5,0.5,0.2\n");
  EXPECT_TRUE(series.is_profile());
  const ReferenceCurve curve = curve_for(series, mirrored(), "m");
  EXPECT_NEAR(curve.first[0], 0.58 - 0.145, 1e-12);
  EXPECT_NEAR(curve.first[1], 0.58, 1e-12);
  EXPECT_DOUBLE_EQ(curve.value[0], 0.145);
  EXPECT_DOUBLE_EQ(curve.limit[0], 0.2 * 0.29);
  EXPECT_DOUBLE_EQ(*curve.at_time, 0.1);
}

TEST(ReferenceSeries, SaysWhatIsWrong) {
  const Written files;
  const auto said = [&](const std::string& text) {
    return error_of([&] { (void)files.read(text); });
  };
  const std::string rows = "t,value\n0,0\n1,0.5\n";
  const auto without = [&](const std::string& line) {
    std::string text = header;
    const auto at = text.find("# " + line);
    return text.erase(at, text.find('\n', at) + 1 - at);
  };
  EXPECT_THAT(said(without("axes:") + rows), HasSubstr("no \"# axes:\" found"));
  EXPECT_THAT(said(header + "# colour: red\n" + rows), HasSubstr("colour: an unknown key found"));
  EXPECT_THAT(said(header + "t,h\n0,0\n1,1\n"), HasSubstr("expected"));
  EXPECT_THAT(said(header + "t,value\n1,0\n1,1\n"), HasSubstr("s.csv:15: t: 1 found, a larger"));
  EXPECT_THAT(said(header + "t,value\n1,0\n2,x\n"), HasSubstr("s.csv:15: value: \"x\" found"));
  EXPECT_THAT(said(without("case:") + "# case: nowhere\n" + rows), HasSubstr("nowhere.toml"));
  EXPECT_THAT(said(without("name:") + "# name: g9\n" + rows), HasSubstr("\"g9\" found"));
  EXPECT_THAT(said(without("time_unit:") + "# time_unit: H\n" + rows), HasSubstr("time_unit"));
  EXPECT_THAT(said(without("observable:") + "# observable: level\n" + rows),
              HasSubstr("one of gauge, pressure, profile expected"));
}

}  // namespace
}  // namespace surge::compare
