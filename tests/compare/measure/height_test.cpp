#include "compare/measure/height.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::append;
using testing::box_mesh;
using testing::lattice;
using testing::particles;
using testing::view_of;

constexpr double l0 = 0.01;

/// A tank of 1 m x 0.4 m, in 3D 0.2 m wide, with the named axis upwards; open above.
Physics tank(int dimension, std::size_t up) {
  Physics physics = testing::dam_break();
  physics.dimension = dimension;
  physics.gravity = {};
  physics.gravity[up] = -9.81;
  Vec3 upper{1.0, 0.2, 0.2};
  if (dimension == 2) upper[3 - up] = 0.0;
  upper[up] = 0.4;
  physics.tank = Extent{{0, 0, 0}, upper};
  physics.column = {{0, 0, 0}, upper};
  physics.column.upper[0] = 0.2;
  physics.open = {up == 1 ? "y+" : "z+"};
  physics.blocks.reset();
  return physics;
}

/// Particles of the lattice that fills the tank, and a mesh of cells of the same size, of the water
/// that `inside` says: where (x, height, across).
struct Water {
  Physics physics;
  FrameView of_particles, of_mesh;

  Water(int dimension, std::size_t up, const std::function<bool(double, double, double)>& inside,
        int samples = 4)
      : physics(tank(dimension, up)),
        of_particles(physics, Metres(l0)),
        of_mesh(physics, Metres(l0)) {
    const auto wet = [&](const Vec3& x) { return inside(x[0], x[up], x[3 - up]); };
    std::vector<Vec3> position = lattice({0, 0, 0}, physics.tank->upper, l0);
    if (dimension == 2 && up == 2) {
      // lattice() is flat along z alone.
      position.clear();
      for (const Vec3& x : lattice({0, 0, 0}, {1.0, 0.4, 0}, l0))
        position.push_back({x[0], 0, x[1]});
    }
    std::erase_if(position, [&](const Vec3& x) { return !wet(x); });
    of_particles.show(particles(position));
    Vec3 upper = physics.tank->upper;
    std::array<int, 3> n{100, 20, 20};
    n[up] = 40;
    if (dimension == 2) {
      n[3 - up] = 1;
      upper[3 - up] = l0;
    }
    of_mesh.show(box_mesh(
        upper, n, [&](const Vec3& x) { return wet(x) ? 1.0 : 0.0; }, samples));
  }

  /// The heights on both sides.
  [[nodiscard]] std::array<double, 2> at(double x, std::optional<double> across = {}) {
    return {water_height(of_particles, {x, across}), water_height(of_mesh, {x, across})};
  }
};

void expect_heights(const std::array<double, 2>& found, double expected, double tolerance) {
  EXPECT_NEAR(found[0], expected, tolerance) << "particles";
  EXPECT_NEAR(found[1], expected, tolerance) << "mesh";
}

/// Every way that a case can lie: dimension and vertical axis.
const std::vector<std::pair<int, std::size_t>> ways{{2, 1}, {2, 2}, {3, 1}, {3, 2}};

TEST(WaterHeight, OfALevelSurfaceIsItsHeightAnywhere) {
  for (const auto& [dimension, up] : ways) {
    Water water(dimension, up, [](double, double z, double) { return z < 0.12; });
    for (const double x : {0.0, 0.004, 0.3, 0.505, 1.0}) expect_heights(water.at(x), 0.12, 1e-9);
    if (dimension == 3) expect_heights(water.at(0.3, 0.2), 0.12, 1e-9);
  }
}

TEST(WaterHeight, OfASurfaceThroughCellsIsExact) {
  // Cells that are filled in part say where in them the surface lies.
  for (const double height : {0.1213, 0.125, 0.1287}) {
    const Physics physics = tank(2, 1);
    FrameView view = view_of(
        box_mesh({1.0, 0.4, 0.01}, {100, 40, 1},
                 [&](const Vec3& x) { return std::clamp((height - x[1]) / l0 + 0.5, 0.0, 1.0); }),
        physics, l0);
    EXPECT_NEAR(water_height(view, {0.3, {}}), height, 1e-9);
  }
}

TEST(WaterHeight, OfASlopeIsThatOfThePlane) {
  // z = 0.05 + x / 5: the window lies evenly around the place, so that the slope adds nothing.
  // Particles of a lattice make steps of a spacing of it, half of one above and below the plane.
  for (const auto& [dimension, up] : ways) {
    Water water(
        dimension, up, [](double x, double z, double) { return z < 0.05 + 0.2 * x; }, 8);
    for (const double x : {0.2, 0.503, 0.8}) {
      const auto [of_particles, of_mesh] = water.at(x);
      EXPECT_NEAR(of_particles, 0.05 + 0.2 * x, 0.51 * l0);
      EXPECT_NEAR(of_mesh, 0.05 + 0.2 * x, 0.1 * l0);
    }
  }
}

TEST(WaterHeight, LeavesDropsInTheAirOut) {
  for (const auto& [dimension, up] : ways) {
    Water water(dimension, up, [](double x, double z, double y) {
      const bool drop = std::abs(x - 0.5) < 0.03 && z > 0.25 && z < 0.31 && y < 0.1;
      return z < 0.1 || drop;
    });
    expect_heights(water.at(0.5), 0.1, 1e-9);
    if (dimension == 3) expect_heights(water.at(0.5, 0.05), 0.1, 1e-9);
  }
}

TEST(WaterHeight, TakesTheHighestSurfaceWhereWaterHangsOver) {
  for (const auto& [dimension, up] : ways) {
    Water water(dimension, up, [](double x, double z, double) {
      const bool column = x < 0.4 && z < 0.3;
      const bool shelf = x < 0.6 && z > 0.2 && z < 0.26;
      return z < 0.1 || column || shelf;
    });
    expect_heights(water.at(0.2), 0.3, 1e-9);
    expect_heights(water.at(0.5), 0.26, 1e-9);
    expect_heights(water.at(0.8), 0.1, 1e-9);
  }
}

TEST(WaterHeight, IsZeroWhereThePlaceIsDryAndCountsAPoolApart) {
  // A pool beyond dry floor stands on it, although the main body is elsewhere.
  for (const auto& [dimension, up] : ways) {
    Water water(dimension, up, [](double x, double z, double) {
      return (x < 0.3 && z < 0.2) || (x > 0.8 && z < 0.05);
    });
    expect_heights(water.at(0.5), 0.0, 1e-12);
    expect_heights(water.at(0.9), 0.05, 1e-9);
  }
}

TEST(WaterHeight, InThreeDimensionsIsThatOfThePlaceOrOfHalfTheWidth) {
  for (const std::size_t up : {1U, 2U}) {
    Water water(3, up, [](double, double z, double y) { return z < (y < 0.06 ? 0.3 : 0.1); });
    expect_heights(water.at(0.5, 0.03), 0.3, 1e-9);
    expect_heights(water.at(0.5, 0.15), 0.1, 1e-9);
    // The high part is not half of the width. Where a part of the width ends, the box of two
    // spacings blurs the height to half of which it is wet.
    expect_heights(water.at(0.5), 0.1, l0);
    Water wide(3, up, [](double, double z, double y) { return z < (y < 0.12 ? 0.3 : 0.1); });
    expect_heights(wide.at(0.5), 0.3, l0);
  }
}

TEST(WaterHeight, OverAnObstacleIsThatOfTheWaterOnIt) {
  // An obstacle from 0.4 to 0.6 m, 0.1 m high, under 0.04 m of water; the mesh has no cells there.
  Physics physics = tank(2, 1);
  physics.obstacles->push_back({{0.4, 0, 0}, {0.6, 0.1, 0}});
  const auto wet = [](const Vec3& x) {
    const bool solid = x[0] > 0.4 && x[0] < 0.6 && x[1] < 0.1;
    return x[1] < 0.14 && !solid;
  };
  std::vector<Vec3> position = lattice({0, 0, 0}, {1.0, 0.4, 0}, l0);
  std::erase_if(position, [&](const Vec3& x) { return !wet(x); });
  FrameView view = view_of(particles(position), physics, l0);
  for (const double x : {0.2, 0.398, 0.4, 0.5})
    EXPECT_NEAR(water_height(view, {x, {}}), 0.14, 1e-9);
  // Where nothing lies on it, it is no water.
  std::erase_if(position, [](const Vec3& x) { return x[1] > 0.1; });
  FrameView dry = view_of(particles(position), physics, l0);
  EXPECT_NEAR(water_height(dry, {0.5, {}}), 0.0, 1e-12);
  EXPECT_NEAR(water_height(dry, {0.2, {}}), 0.1, 1e-9);
}

TEST(WaterHeight, OfAFullTankIsItsLid) {
  const Physics physics = tank(2, 1);
  FrameView view = view_of(
      box_mesh({1.0, 0.4, 0.01}, {100, 40, 1}, [](const Vec3&) { return 1.0; }), physics, l0);
  EXPECT_NEAR(water_height(view, {0.5, {}}), 0.4, 1e-12);
}

TEST(WaterHeight, OutsideOfTheTankIsAnError) {
  Water water(2, 1, [](double, double z, double) { return z < 0.1; });
  for (FrameView* view : {&water.of_particles, &water.of_mesh}) {
    EXPECT_THAT(testing::error_of([&] {
                  (void)water_height(*view, {1.2, {}});
                }),
                ::testing::HasSubstr("outside of the tank"));
  }
}

TEST(WaterHeight, IsLittleDisturbedByParticlesOutOfTheirLattice) {
  // Each particle moved by up to a fifth of a spacing, the same way each time.
  Physics physics = tank(2, 1);
  std::vector<Vec3> position = lattice({0, 0, 0}, {1.0, 0.12, 0}, l0);
  for (std::size_t i = 0; i < position.size(); ++i) {
    position[i][0] += 0.2 * l0 * std::sin(12.9898 * static_cast<double>(i));
    position[i][1] += 0.2 * l0 * std::sin(78.233 * static_cast<double>(i));
  }
  FrameView view = view_of(particles(position), physics, l0);
  for (int k = 0; k <= 40; ++k)
    EXPECT_NEAR(water_height(view, {0.3 + 0.01 * k, {}}), 0.12, 0.5 * l0) << k;
}

}  // namespace
}  // namespace surge::compare
