#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/measure/front.hpp"
#include "tests/compare/measure/frames_in_memory.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::lattice;
using testing::MemoryRun;

constexpr double l0 = 0.01, width = 1.0, depth = 0.04, height = 0.4;
/// Where the water stands higher than this the front is: d + 0.1 (H - d).
constexpr double level = depth + 0.1 * (height - depth);

/// Column 0.2 m wide and 0.4 m high in a tank 1 m long with water 0.04 m deep; 3D with z upwards.
Physics wet_bed(int dimension, bool mirrored) {
  Physics physics = testing::dam_break();
  physics.dimension = dimension;
  const std::size_t up = dimension == 2 ? 1 : 2;
  physics.gravity = {};
  physics.gravity[up] = -9.81;
  Vec3 upper{width, 0.1, 0.1};
  upper[up] = 0.6;
  if (dimension == 2) upper[2] = 0.0;
  physics.tank = Extent{{0, 0, 0}, upper};
  physics.column = *physics.tank;
  physics.column.upper[up] = height;
  Extent bed = physics.column;
  bed.upper[up] = depth;
  (mirrored ? physics.column.lower : physics.column.upper)[0] = mirrored ? width - 0.2 : 0.2;
  (mirrored ? bed.upper : bed.lower)[0] = mirrored ? width - 0.2 : 0.2;
  physics.blocks = {{"box", bed, {}}, {"box", physics.column, {}}};
  return physics;
}

/// A bore with an upright face at x = front, 0.16 m high behind it; a column at the wall.
std::function<bool(const Vec3&)> bore(double front, std::size_t up, bool mirrored) {
  return [=](Vec3 x) {
    if (mirrored) x[0] = width - x[0];
    return x[up] < depth || (x[0] < front && x[up] < 0.16) || (x[0] < 0.15 && x[up] < height);
  };
}

Frame particles_of(const Physics& physics, const std::function<bool(const Vec3&)>& wet,
                   double time = 0.0) {
  std::vector<Vec3> position = lattice({0, 0, 0}, physics.tank->upper, l0);
  std::erase_if(position, [&](const Vec3& x) { return !wet(x); });
  return testing::particles(position, time);
}

Frame mesh_of(const Physics& physics, const std::function<bool(const Vec3&)>& wet) {
  const bool flat = physics.dimension == 2;
  Vec3 upper = physics.tank->upper;
  std::array<int, 3> n{100, 10, 60};
  if (flat) {
    n = {100, 60, 1};
    upper[2] = l0;
  }
  return testing::box_mesh(upper, n, [&](const Vec3& x) { return wet(x) ? 1.0 : 0.0; });
}

double front_of(const Frame& frame, const Physics& physics, const FrontOptions& options = {}) {
  FrameView view = testing::view_of(frame, physics, l0);
  const double edge = leading_edge(view, options).value();
  return physics.surge_direction() * (edge - physics.column_wall());
}

TEST(WetBedFront, IsTheFaceOfTheBoreOnParticlesAndMeshes) {
  for (const int dimension : {2, 3}) {
    for (const bool mirrored : {false, true}) {
      const Physics physics = wet_bed(dimension, mirrored);
      const std::size_t up = dimension == 2 ? 1 : 2;
      ASSERT_NEAR(physics.bed_depth()->value(), depth, 1e-12);
      for (const double front : {0.3, 0.62}) {
        EXPECT_NEAR(front_of(particles_of(physics, bore(front, up, mirrored)), physics), front,
                    1e-9);
        EXPECT_NEAR(front_of(mesh_of(physics, bore(front, up, mirrored)), physics), front, 1e-9);
      }
    }
  }
}

TEST(WetBedFront, OfASlopeIsWhereItPassesTheLevel) {
  // The surface falls from 0.16 m at x = 0.3 to the bed at x = 0.54, that is by 1 in 2.
  const auto slope = [](const Vec3& x) {
    return x[1] < std::clamp(0.16 - 0.5 * (x[0] - 0.3), depth, 0.16) ||
           (x[0] < 0.1 && x[1] < height);
  };
  const Physics physics = wet_bed(2, false);
  const double expected = 0.3 + (0.16 - level) / 0.5;
  EXPECT_NEAR(front_of(particles_of(physics, slope), physics), expected, 1.0 * l0);
  EXPECT_NEAR(front_of(mesh_of(physics, slope), physics), expected, 1.0 * l0);
}

TEST(WetBedFront, DoesNotMindWavesOnTheBedBelowTheLevel) {
  const auto wet = [](const Vec3& x) {
    return bore(0.3, 1, false)(x) || x[1] < depth + 0.02 * std::sin(40.0 * x[0]);
  };
  const Physics physics = wet_bed(2, false);
  EXPECT_NEAR(front_of(particles_of(physics, wet), physics), 0.3, 1e-9);
  EXPECT_NEAR(front_of(mesh_of(physics, wet), physics), 0.3, 1e-9);
}

TEST(WetBedFront, AsksForWhatItDoesNotKnow) {
  const Physics physics = wet_bed(2, false);
  const auto refusal = [&](const Physics& p, double spacing, const FrontOptions& options) {
    return error_of([&] { (void)front_strip(p, Metres(spacing), true, options); });
  };
  FrontOptions raw;
  raw.raw_maximum = true;
  EXPECT_THAT(refusal(physics, l0, raw), HasSubstr("--raw-maximum"));
  EXPECT_THAT(refusal(physics, 0.05, {}), HasSubstr("--bed-share"));
  Physics unknown = physics;
  unknown.column.upper[1] = std::nan("");
  EXPECT_THAT(refusal(unknown, l0, {}), HasSubstr("--column-height"));
}

TEST(WetBedFront, OfARunThatDoesNotSayItsBedIsAnErrorThatNamesTheOption) {
  Physics physics = wet_bed(2, false);
  const auto frames = [&](double start) {
    std::vector<Frame> all;
    for (const double t : {0.0, 0.1})
      all.push_back(particles_of(physics, bore(0.2 + t, 1, false), start + t));
    return all;
  };
  physics.blocks.reset();
  for (const double start : {0.0, 0.3}) {
    MemoryRun memory(frames(start), physics, l0);
    EXPECT_THAT(error_of([&] { (void)measure_front(memory.run, {}); }), HasSubstr("--bed-depth"))
        << start;
  }
  physics.stated_bed = Metres(depth);
  MemoryRun memory(frames(0.0), physics, l0);
  const FrontHistory history = measure_front(memory.run, {});
  ASSERT_EQ(history.size(), 2U);
  EXPECT_NEAR(history[1].position.value(), 0.3, 1e-9);
  EXPECT_THAT(memory.run.notices, ::testing::Contains(HasSubstr("front on a wet bed of 0.04 m")));
}

}  // namespace
}  // namespace surge::compare
