#include "compare/read/first_frame.hpp"

#include <gmock/gmock.h>

#include "compare/measure/front.hpp"
#include "tests/compare/foreign_flow.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::lattice;
using testing::TemporaryFolder;
using testing::write_vtp;

/// A column 0.1 m x 0.2 m of particles 0.01 m apart that reaches 0.1 + 0.01 i in frame i.
std::vector<Vec3> column(int i, double scale = 1.0) {
  std::vector<Vec3> points = lattice({0, 0, 0}, {0.1, 0.2, 0}, 0.01);
  testing::append(points, lattice({0.1, 0, 0}, {0.1 + 0.01 * i, 0.02, 0}, 0.01));
  for (Vec3& x : points)
    for (double& c : x) c *= scale;
  return points;
}

/// A tank's walls, one layer, 0.4 m wide.
std::vector<Vec3> walls() {
  std::vector<Vec3> points = lattice({-0.01, -0.01, 0}, {0.41, 0, 0}, 0.01);
  testing::append(points, lattice({-0.01, 0, 0}, {0, 0.3, 0}, 0.01));
  testing::append(points, lattice({0.4, 0, 0}, {0.41, 0.3, 0}, 0.01));
  return points;
}

class ForeignSeries {
 public:
  void write(int i, const std::vector<Vec3>& points, const std::vector<int>& type = {},
             const std::string& type_name = "x", double interval = 0.02) const {
    write_vtp(folder_ / ("p_" + std::to_string(i) + ".vtp"), points, type, type_name, interval * i);
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path(); }

  SourceOptions options = [] {
    SourceOptions o;
    o.spacing = Metres(0.01);
    o.gravity = 9.81;
    return o;
  }();

  [[nodiscard]] std::string error() const {
    return testing::refusal_of([&] { (void)open_run(path(), options); });
  }
  [[nodiscard]] std::string front_error() const {
    return testing::refusal_of([&] {
      auto run = open_run(path(), options);
      (void)measure_front(run, {.strip_height = Metres(0.03)});
    });
  }

 private:
  TemporaryFolder folder_;
};

TEST(FirstFrame, ColumnPasses) {
  ForeignSeries series;
  for (int i = 0; i < 4; ++i) series.write(i, column(i));
  EXPECT_EQ(series.front_error(), "");
}

TEST(FirstFrame, WallsAmongTheWaterAreRefused) {
  ForeignSeries series;
  std::vector<Vec3> points = column(0);
  testing::append(points, walls());
  series.write(0, points);
  EXPECT_THAT(series.error(), HasSubstr("% of the box that they span"));
  EXPECT_THAT(series.error(), HasSubstr("--type-array"));
}

TEST(FirstFrame, ArrayThatLooksLikeATypeIsNamedWithItsValues) {
  ForeignSeries series;
  std::vector<Vec3> points = column(0);
  std::vector<int> type(points.size(), 3);
  testing::append(points, walls());
  type.resize(points.size(), 1);
  series.write(0, points, type, "Kind");
  EXPECT_THAT(series.error(), HasSubstr("\"Kind\" looks like a type"));
  EXPECT_THAT(series.error(), HasSubstr("Kind (int, 1 component, 1 to 3: 1 x 102, 3 x 200)"));
  series.options.type_array = "Kind";
  series.options.type_required = true;
  series.options.fluid_type = 3;
  EXPECT_EQ(series.error(), "");
  series.options.fluid_type = 1;
  EXPECT_THAT(series.error(), HasSubstr("first frame"));
}

TEST(FirstFrame, AllThatIsMissingIsAskedForAtOnce) {
  const TemporaryFolder folder;
  write_vtp(folder / "p_0.vtp", column(0), {}, "x");
  const std::string error = error_of([&] { (void)open_run(folder.path(), {}); });
  for (const char* part :
       {"--spacing", "--gravity", "--time-step", "velocity (double, 3 components"})
    EXPECT_THAT(error, HasSubstr(part));
}

TEST(FirstFrame, SpacingThatIsNotTheFilesIsRefused) {
  ForeignSeries series;
  series.write(0, column(0, 1000.0));
  EXPECT_THAT(series.error(), HasSubstr("10 m from their nearest neighbour"));
  EXPECT_THAT(series.error(), HasSubstr("--spacing"));
}

TEST(FirstFrame, SeparateBodiesAreRefused) {
  ForeignSeries series;
  std::vector<Vec3> points = column(0);
  testing::append(points, lattice({0.3, 0, 0}, {0.4, 0.1, 0}, 0.01));
  series.write(0, points);
  EXPECT_THAT(series.error(), HasSubstr("2 separate bodies, the largest with 200 of 300"));
}

TEST(FirstFrame, WaterLyingInTheTankIsRefused) {
  ForeignSeries series;
  std::vector<Vec3> points = column(0);
  testing::append(points, lattice({0.1, 0, 0}, {0.4, 0.01, 0}, 0.01));
  series.write(0, points);
  EXPECT_THAT(series.error(), HasSubstr("water lying in the tank"));
  series.options.column_width = Metres(0.1);
  series.options.column_height = Metres(0.2);
  EXPECT_THAT(series.front_error(), HasSubstr("the leading edge is 0.4 m"));
}

TEST(FirstFrame, WrongVerticalAxisIsRefused) {
  ForeignSeries series;
  series.write(0, column(0));
  series.options.vertical_axis = 2;
  EXPECT_THAT(series.error(), HasSubstr("--vertical"));
}

TEST(FirstFrame, WrongAxisOfTheSurgeIsRefused) {
  const auto error_with = [](Vec3 (*place)(Vec3), const std::vector<std::string>& axes) {
    ForeignSeries series;
    for (int i = 0; i < 3; ++i) {
      std::vector<Vec3> points;
      for (int layer = 0; layer < 3; ++layer)
        for (const Vec3& x : testing::ForeignFlow().fluid(5 * i))
          points.push_back(place({x[0], x[1], 0.01 * layer}));
      series.write(i, points);
    }
    if (!axes.empty()) series.options.axes = FileAxes::parse(axes, "axes");
    return series.error();
  };
  const auto left = [](Vec3 x) { return Vec3{0.4 - x[0], x[1], x[2]}; };
  EXPECT_THAT(error_with(left, {}), HasSubstr("towards its wall (--axes, such as -x,y"));
  EXPECT_EQ(error_with(left, {"-x", "y"}), "");
  const auto across = [](Vec3 x) { return Vec3{x[2], x[1], x[0]}; };
  EXPECT_THAT(error_with(across, {}), HasSubstr("more across the surge than along it"));
  EXPECT_EQ(error_with(across, {"z", "y"}), "");
}

TEST(FirstFrame, TimeStepThatIsTypedWrongIsRefused) {
  for (const double interval : {2.0, 2e-4}) {
    ForeignSeries series;
    for (int i = 0; i < 12; ++i) series.write(i, column(2 * i), {}, "x", interval);
    EXPECT_THAT(series.front_error(), HasSubstr("--time-step")) << interval;
  }
}

TEST(FirstFrame, LengthsInMillimetresAreRefusedWithTheirOwnSpacing) {
  ForeignSeries series;
  series.options.spacing = Metres(10.0);
  for (int i = 0; i < 12; ++i) series.write(i, column(2 * i, 1000.0));
  const std::string error = error_of([&] {
    auto run = open_run(series.path(), series.options);
    (void)measure_front(run, {.strip_height = Metres(30.0)});
  });
  EXPECT_THAT(error, HasSubstr("millimetres"));
}

TEST(FirstFrame, ThreeDimensionalColumnPassesAndIsMeasured) {
  ForeignSeries series;
  for (int i = 0; i < 2; ++i)
    series.write(i, lattice({0, 0, 0}, {0.1 + 0.02 * i, 0.2, 0.05}, 0.01));
  auto run = open_run(series.path(), series.options);
  EXPECT_EQ(run.physics.dimension, 3);
  const FrontHistory history = measure_front(run, {.strip_height = Metres(0.03)});
  EXPECT_NEAR(history[1].position.value(), 0.12, 1e-9);
}

TEST(NearestDistance, IsTheLatticesSpacing) {
  EXPECT_NEAR(nearest_distance(lattice({0, 0, 0}, {1, 1, 0}, 0.05)), 0.05, 1e-12);
  EXPECT_NEAR(nearest_distance(lattice({0, 0, 0}, {0.5, 0.5, 0.5}, 0.05)), 0.05, 1e-12);
}

}  // namespace
}  // namespace surge::compare
