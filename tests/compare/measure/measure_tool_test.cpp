#include <gmock/gmock.h>

#include "compare/measure/registry.hpp"
#include "compare/study/baseline_check.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using testing::foreign_front;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

/// A run of DualSPHysics 5.4 with tables of its MeasureTool, which has z upwards.
class MeasureTool : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_dualsphysics_vtk(folder_ / "run/vtks");
    testing::write_dualsphysics_run(folder_ / "run");
    write_text(folder_ / "run/measuretool/Points_Press.csv",
               " ;PosX [m]:;0.1;0.395\n ;PosY [m]:;0;0\n ;PosZ [m]:;0.02;0.015\n"
               "Part;Time [s];Press_0 [Pa];Press_1 [Pa]\n"
               "0;0;1500;0\n1;0.02;1250.5;0\n2;0.0400007;900;-20\n");
    write_text(folder_ / "run/measuretool/wg_Elevation.csv",
               " ;PosX [m]:;0.05\n ;PosY [m]:;0\n ;PosZ [m]:;0.2\n"
               "Part;Time [s];Elevation_0 [m]\n0;0;0.2\n1;0.02;0.19\n");
  }
  [[nodiscard]] Findings measure(const std::string& observable) const {
    return observe(open_run(folder_ / "run"), foreign_front(), {observable}).found.front();
  }
  TemporaryFolder folder_;
};

TEST_F(MeasureTool, PressureAtAPlaceIsWhatItRecorded) {
  const Findings found = measure("pressure:x=0.395,y=0.015");
  ASSERT_FALSE(found.failure) << *found.failure;
  const TimeSeries& series = found.series.front();
  ASSERT_EQ(series.times.size(), 3U);
  EXPECT_EQ(series.times[2].value(), 0.0400007);
  EXPECT_EQ(series.values[2], -20.0);
  EXPECT_THAT(found.notices.front(), HasSubstr("as recorded by Points_Press.csv"));
  EXPECT_EQ(*measure("pressure:x=0.1,y=0.02").series.front().values[1], 1250.5);
}

TEST_F(MeasureTool, ElevationOnlyWhereItIsAskedFor) {
  const Findings recorded = measure("gauge:x=0.05,recorded=yes");
  ASSERT_FALSE(recorded.failure) << *recorded.failure;
  EXPECT_NEAR(*recorded.series.front().values[1], 0.19, 1e-9);
  const Findings own = measure("gauge:x=0.05");
  ASSERT_FALSE(own.failure);
  EXPECT_EQ(own.series.front().values.size(), 6U);
  EXPECT_THAT(measure("gauge:x=0.3,recorded=yes").failure.value_or(""), HasSubstr("no table"));
}

TEST_F(MeasureTool, DamagedAndDoubleTablesAreErrors) {
  write_text(folder_ / "run/measuretool/Again_Press.csv",
             ";PosX [m]:;0.395\n;PosY [m]:;0\n;PosZ [m]:;0.015\n"
             "Part;Time [s];Press_0 [Pa]\n0;0;1\n");
  EXPECT_THAT(measure("pressure:x=0.395,y=0.015").failure.value_or(""), HasSubstr("both hold"));
  write_text(folder_ / "run/measuretool/Again_Press.csv",
             ";PosX [m]:;0.2\n;PosY [m]:;0\n;PosZ [m]:;0.015\n"
             "Part;Time [s];Press_0 [Pa]\n0;0;1\n1;nan;2\n");
  EXPECT_THAT(measure("pressure:x=0.1,y=0.02").failure.value_or(""),
              HasSubstr("Again_Press.csv:6: expected a finite number instead of \"nan\""));
  write_text(folder_ / "run/measuretool/Again_Press.csv",
             ";PosX [m]:;0.2\n;PosY [m]:;0\n;PosZ [m]:;0.015\n"
             "Part;Time [s];Press_0 [Pa]\n1;0.1;1\n2;0.1;2\n");
  EXPECT_THAT(measure("pressure:x=0.1,y=0.02").failure.value_or(""), HasSubstr("a later time"));
}

}  // namespace
}  // namespace surge::compare
