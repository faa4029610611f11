#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/measure/measure_all.hpp"
#include "compare/measure/registry.hpp"
#include "tests/compare/measure/frames_in_memory.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using testing::lattice;
using testing::MemoryRun;

constexpr double l0 = 0.01;

/// A column 0.2 m wide and 0.3 m high at one wall of a tank 1 m x 0.4 m, in 3D 0.1 m wide.
Physics tank(int dimension, std::size_t up, bool mirrored) {
  Physics physics = testing::dam_break();
  physics.dimension = dimension;
  physics.gravity = {};
  physics.gravity[up] = -9.81;
  Vec3 upper{1.0, 0.1, 0.1};
  upper[up] = 0.4;
  if (dimension == 2) upper[3 - up] = 0.0;
  physics.tank = Extent{{0, 0, 0}, upper};
  physics.column = *physics.tank;
  physics.column.upper[up] = 0.3;
  (mirrored ? physics.column.lower : physics.column.upper)[0] = mirrored ? 0.8 : 0.2;
  physics.blocks = {{"box", physics.column, {}}};
  return physics;
}

/// The frame of water below a height over the distance from the column's wall.
Frame frame_of(const Physics& physics, bool mesh, bool mirrored,
               const std::function<double(double)>& height, double time = 0.0) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const auto wet = [&](const Vec3& x) { return x[up] < height(mirrored ? 1.0 - x[0] : x[0]); };
  std::array<int, 3> n{100, 10, 10};
  n[up] = 40;
  if (physics.dimension == 2) n[3 - up] = 1;
  if (mesh) {
    MeshFrame frame = testing::box_mesh({n[0] * l0, n[1] * l0, n[2] * l0}, n,
                                        [&](const Vec3& x) { return wet(x) ? 1.0 : 0.0; });
    frame.time = Seconds(time);
    return frame;
  }
  std::vector<Vec3> position = lattice({0, 0, 0}, {n[0] * l0, n[1] * l0, n[2] * l0}, l0);
  std::erase_if(position, [&](const Vec3& x) { return !wet(x); });
  return testing::particles(position, time);
}

/// Both sides in 2D and 3D, y or z upwards, column at the lower or the upper wall.
void for_all(const std::function<void(const Physics&, bool mesh, bool mirrored)>& check) {
  for (const int dimension : {2, 3})
    for (const std::size_t up : {1U, 2U})
      for (const bool mesh : {false, true})
        for (const bool mirrored : {false, true}) {
          SCOPED_TRACE(std::to_string(dimension) + "D, axis " + std::to_string(up) +
                       (mesh ? ", mesh" : ", particles") + (mirrored ? ", mirrored" : ""));
          check(tank(dimension, up, mirrored), mesh, mirrored);
        }
}

Findings measured(MemoryRun& memory, const std::string& request, const Run* reference = nullptr) {
  std::vector<std::unique_ptr<Observable>> one;
  one.push_back(make_observable(request, {memory.run, {}, reference}));
  Findings found = measure_all(memory.run, one).front();
  EXPECT_FALSE(found.failure) << found.failure.value_or("");
  return found;
}

double step(double from_wall) {
  return from_wall < 0.2 ? 0.3 : 0.0;
}
double steps(double from_wall) {
  return from_wall < 0.2 ? 0.25 : from_wall < 0.5 ? 0.1 : from_wall < 0.7 ? 0.04 : 0.0;
}

TEST(ColumnHeight, IsThatAtTheWallOfTheColumn) {
  for_all([](const Physics& physics, bool mesh, bool mirrored) {
    MemoryRun memory({frame_of(physics, mesh, mirrored, step, 0.0),
                      frame_of(physics, mesh, mirrored, steps, 0.1)},
                     physics, l0);
    const TimeSeries found = measured(memory, "column-height").series[0];
    EXPECT_EQ(found.unit, "m");
    EXPECT_NEAR(*found.values[0], 0.3, 1e-9);
    EXPECT_NEAR(*found.values[1], 0.25, 1e-9);
  });
}

TEST(FrontObservable, IsTheDistanceFromTheWallOfTheColumn) {
  for_all([](const Physics& physics, bool mesh, bool mirrored) {
    MemoryRun memory({frame_of(physics, mesh, mirrored, step, 0.0),
                      frame_of(physics, mesh, mirrored, steps, 0.2)},
                     physics, l0);
    const TimeSeries found = measured(memory, "front").series[0];
    EXPECT_NEAR(*found.values[0], 0.2, 1e-9);
    EXPECT_NEAR(*found.values[1], 0.7, 1e-9);
  });
}

TEST(ProfileObservable, IsTheSurfaceOverTheTank) {
  for_all([](const Physics& physics, bool mesh, bool mirrored) {
    MemoryRun memory({frame_of(physics, mesh, mirrored, step, 0.0),
                      frame_of(physics, mesh, mirrored, steps, 0.1)},
                     physics, l0);
    const Findings found = measured(memory, "profile:times=0.1;0,step=0.02");
    ASSERT_EQ(found.profiles.size(), 2U);
    EXPECT_EQ(found.profiles[0].time, Seconds(0.0));
    const Profile& profile = found.profiles[1];
    ASSERT_EQ(profile.positions.size(), 50U);
    EXPECT_EQ(profile.unit, "m");
    for (std::size_t k = 0; k < 50; ++k) {
      const double x = profile.positions[k];
      EXPECT_NEAR(x, 0.02 * (static_cast<double>(k) + 0.5), 1e-12);
      // Away from the steps of the surface, where a box of two cells lies on both sides.
      const double from_wall = mirrored ? 1.0 - x : x;
      bool at_step = false;
      for (const double edge : {0.2, 0.5, 0.7})
        at_step = at_step || std::abs(from_wall - edge) < 1.01 * l0;
      if (at_step) continue;
      EXPECT_NEAR(*profile.values[k], steps(from_wall), 1e-9) << x;
    }
  });
}

TEST(OverlapObservable, OfTwoThirdsOfTheWater) {
  for_all([](const Physics& physics, bool mesh, bool mirrored) {
    const auto lower = [](double from_wall) { return from_wall < 0.2 ? 0.2 : 0.0; };
    MemoryRun memory({frame_of(physics, mesh, mirrored, step, 0.0),
                      frame_of(physics, mesh, mirrored, step, 0.1)},
                     physics, l0);
    // Particles against a mesh and the other way round; the reference ends before the run.
    MemoryRun reference({frame_of(physics, !mesh, mirrored, lower, 0.0),
                         frame_of(physics, !mesh, mirrored, step, 0.05)},
                        physics, l0);
    const TimeSeries found = measured(memory, "overlap", &reference.run).series[0];
    EXPECT_NEAR(*found.values[0], 2.0 / 3.0, 1e-9);
    EXPECT_FALSE(found.values[1]);
    EXPECT_EQ(found.absent(), 1U);
  });
}

TEST(OverlapObservable, WithoutAReferenceAsksForIt) {
  const Physics physics = tank(2, 1, false);
  MemoryRun memory({frame_of(physics, false, false, step)}, physics, l0);
  EXPECT_THAT(testing::error_of([&] { (void)measured(memory, "overlap"); }),
              HasSubstr("--reference"));
}

TEST(DetachedObservable, CountsThePieces) {
  for_all([](const Physics& physics, bool mesh, bool mirrored) {
    // A second body of 0.1 m x 0.1 m away from the column: 0.01 of 0.07 m2.
    const auto two = [](double d) { return d < 0.2 ? 0.3 : d > 0.5 && d < 0.6 ? 0.1 : 0.0; };
    MemoryRun memory({frame_of(physics, mesh, mirrored, two)}, physics, l0);
    const Findings found = measured(memory, "detached");
    ASSERT_EQ(found.series.size(), 3U);
    EXPECT_EQ(*found.series[0].values[0], 1.0);
    EXPECT_NEAR(*found.series[1].values[0], 1.0 / 7.0, 0.01);
    EXPECT_NEAR(*found.series[2].values[0], 0.0, 0.03);
  });
}

TEST(GaugeObservable, OfAGaugeThatTheCaseNames) {
  for_all([](const Physics& physics, bool mesh, bool mirrored) {
    MemoryRun memory({frame_of(physics, mesh, mirrored, steps)}, physics, l0);
    const double x = mirrored ? 0.65 : 0.35;
    memory.run.manifest["case"]["gauges"] = {{{"name", "H1"}, {"position", {x, 0.05, 0.05}}}};
    EXPECT_NEAR(*measured(memory, "gauge:name=H1").series[0].values[0], 0.1, 1e-9);
    EXPECT_THAT(testing::error_of([&] { (void)measured(memory, "gauge:name=H2"); }),
                HasSubstr("expected one of H1"));
  });
}

TEST(FrontVariants, AreMeasuredInTheSamePass) {
  const Physics physics = tank(2, 1, false);
  // A tongue 1.5 spacings beyond a gap: with a shorter linking length it is no longer connected.
  ParticleFrame frame = testing::particles(lattice({0, 0, 0}, {0.2, 0.3, 0}, l0));
  testing::append(frame.position, lattice({0.2 + 0.8 * l0, 0, 0}, {0.3 + 0.8 * l0, 0.01, 0}, l0));
  // Above the strip, below twice its height.
  testing::append(frame.position, lattice({0.2, 0.04, 0}, {0.4, 0.05, 0}, l0));
  ParticleFrame start = testing::particles(lattice({0, 0, 0}, {0.2, 0.3, 0}, l0), 0.0);
  frame.time = Seconds(0.1);
  MemoryRun memory({start, frame}, physics, l0);
  FrontOptions options;
  options.strip_height = Metres(3.0 * l0);
  const FrontWithVariants found = measure_front_variants(memory.run, options);
  for (const auto& reads : memory.frames->reads) EXPECT_EQ(reads.size(), 1U);
  ASSERT_EQ(found.variants.size(), 3U);
  EXPECT_NEAR(found.front[1].position.value(), 0.3 + 0.8 * l0, 1e-9);
  EXPECT_EQ(found.variants[0].name, "strip_x2");
  EXPECT_NEAR(found.variants[0].history[1].position.value(), 0.4, 1e-9);
  EXPECT_EQ(found.variants[1].name, "linking_1.5");
  EXPECT_NEAR(found.variants[1].history[1].position.value(), 0.2, 1e-9);
  EXPECT_NEAR(found.variants[2].history[1].position.value(), 0.3 + 0.8 * l0, 1e-9);
}

}  // namespace
}  // namespace surge::compare
