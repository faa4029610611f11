#include <gmock/gmock.h>

#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using ::testing::Contains;
using testing::error_of;
using testing::ForeignFlow;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr double l0 = ForeignFlow::l0;

/// A column 0.1 m x 0.3 m in a tank 0.4 m wide with water 0.03 m deep. In frame i a bore of upright
/// face, 0.09 m high, reaches x = 0.1 + 0.05 i m; its water comes from the top of the column.
std::vector<Vec3> bore(int i, int dimension) {
  std::vector<Vec3> points;
  for (int k = 0; k < 40; ++k) {
    const int rows = k < 10 ? 30 - 3 * i : k < 10 + 5 * i ? 9 : 3;
    for (int row = 0; row < rows; ++row) {
      const double x = l0 * (k + 0.5), up = l0 * (row + 0.5);
      if (dimension == 2) points.push_back({x, up, 0.0});
      for (int across = 0; dimension == 3 && across < 5; ++across)
        points.push_back({x, l0 * (across + 0.5), up});
    }
  }
  return points;
}

void write(const TemporaryFolder& folder, int dimension) {
  for (int i = 0; i < 3; ++i)
    testing::write_vtu(folder / ("f_" + std::to_string(i) + ".vtu"), bore(i, dimension), "", "Time",
                       0.05 * i);
}

SourceOptions facts(int dimension) {
  SourceOptions options = testing::foreign_facts();
  const std::vector<std::string> z{"z"}, depth{"0.03"}, density{"998"};
  if (dimension == 3) set_source_option(options, "vertical", z, "--vertical", ".");
  set_source_option(options, "bed_depth", depth, "--bed-depth", ".");
  set_source_option(options, "density", density, "--density", ".");
  return options;
}

TEST(ForeignWetBed, ColumnIsWhatStandsOutOfTheBed) {
  for (const int dimension : {2, 3}) {
    const TemporaryFolder folder;
    write(folder, dimension);
    auto run = open_run(folder.path(), facts(dimension));
    EXPECT_EQ(run.physics.dimension, dimension);
    EXPECT_NEAR(run.physics.column_width().value(), 0.1, 1e-9);
    EXPECT_NEAR(run.physics.floor(), 0.0, 1e-9);
    const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
    EXPECT_NEAR(run.physics.column.upper[up], 0.3, 1e-9);
    EXPECT_EQ(run.physics.bed_depth()->value(), 0.03);
    EXPECT_EQ(run.physics.density, 998.0);
    const FrontHistory front = measure_front(run, {});
    ASSERT_EQ(front.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(front[i].position.value(), 0.1 + 0.05 * static_cast<double>(i), 1e-9) << i;
    EXPECT_THAT(run.notices, Contains(HasSubstr("front on a wet bed of 0.03 m")));
    EXPECT_THAT(run.notices, ::testing::Not(Contains(HasSubstr("face"))));
  }
}

TEST(ForeignWetBed, WithoutItsDepthIsRefusedAndTheOptionNamed) {
  const TemporaryFolder folder;
  write(folder, 2);
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), testing::foreign_facts()); }),
              HasSubstr("--bed-depth how deep"));
  SourceOptions deep = facts(2);
  deep.bed_depth = Metres(0.5);
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), deep); }),
              HasSubstr("--bed-depth: found no water above 0.5 m"));
}

TEST(ForeignWetBed, OneParticleAheadOnTheBedIsNoLead) {
  const TemporaryFolder folder;
  write(folder, 2);
  // Below the level of the front, which is 0.057 m.
  std::vector<Vec3> points = bore(2, 2);
  points.push_back({0.265, 0.035, 0.0});
  testing::write_vtu(folder / "f_2.vtu", points, "", "Time", 0.1);
  auto low = open_run(folder.path(), facts(2));
  EXPECT_NEAR(measure_front(low, {}).back().position.value(), 0.2, 1e-9);
  EXPECT_THAT(low.notices, ::testing::Not(Contains(HasSubstr("one particle makes"))));
  points.back() = {0.205, 0.065, 0.0};
  testing::write_vtu(folder / "f_2.vtu", points, "", "Time", 0.1);
  auto high = open_run(folder.path(), facts(2));
  EXPECT_NEAR(measure_front(high, {}).back().position.value(), 0.21, 1e-9);
  EXPECT_THAT(high.notices, Contains(HasSubstr("in 1 of 3 frames one particle makes")));
}

}  // namespace
}  // namespace surge::compare
