#include "particle/io/surface_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surge {
namespace {

constexpr double l0 = 0.01;
constexpr double rho_g = 9810.0;

/// A tank 0.2 m square (0.1 m deep in 3D), open at the top, full of water up to y = 0.15, but for a
/// box from (0.08, 0) to (0.12, 0.06).
template <int D>
struct Basin {
  Basin() {
    c.dimension = D;
    c.spacing = l0;
    c.has_tank = true;
    const double depth = D == 3 ? 0.1 : 0.0;
    c.tank.box = {{0.0, 0.0, 0.0}, {0.2, 0.2, depth}};
    c.tank.open[3] = true;
    c.obstacles = {{{0.08, 0.0, 0.0}, {0.12, 0.06, depth}}};
    fill([](double y) { return rho_g * (0.15 - y); });
  }
  template <class Pressure>
  void fill(Pressure pressure) {
    water = {};
    const int layers = D == 3 ? 10 : 1;
    for (int z = 0; z < layers; ++z)
      for (int y = 0; y < 15; ++y)
        for (int x = 0; x < 20; ++x) {
          if (x >= 8 && x < 12 && y < 6) continue;
          const std::size_t k = water.size();
          water.resize(k + 1);
          water.x[0][k] = (x + 0.5) * l0;
          water.x[1][k] = (y + 0.5) * l0;
          if constexpr (D == 3) water.x[2][k] = (z + 0.5) * l0;
          water.pressure[k] = pressure(water.x[1][k]);
        }
  }
  /// Area of what is as wide as the tank is deep, per height.
  static constexpr double width = D == 3 ? 0.1 : 1.0;
  Case c;
  Particles<D> water;
};

template <class Dimension>
class SurfaceForcesOf : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SurfaceForcesOf, Dimensions);

TYPED_TEST(SurfaceForcesOf, StillWaterPressesOnWallsAndFloor) {
  constexpr int D = TypeParam::value;
  Basin<D> basin;
  basin.c.forces = {{"left", ForceSurface::Of::side, 0},
                    {"right", ForceSurface::Of::side, 1},
                    {"floor", ForceSurface::Of::side, 2}};
  SurfaceForces<D> forces(basin.c);
  const auto& f = forces.measure(basin.water, 0.0);
  const double side = 0.5 * rho_g * 0.15 * 0.15 * Basin<D>::width;
  EXPECT_NEAR(f[0][0], -side, 0.05 * side);
  EXPECT_NEAR(f[1][0], side, 0.05 * side);
  EXPECT_EQ(f[0][1], 0.0);
  // The floor under the box is dry.
  const double weight = rho_g * 0.15 * 0.16 * Basin<D>::width;
  EXPECT_NEAR(f[2][1], -weight, 0.1 * weight);
  EXPECT_EQ(f[2][0], 0.0);
}

TYPED_TEST(SurfaceForcesOf, ABoxOnTheFloorIsPressedDownAndNotAside) {
  constexpr int D = TypeParam::value;
  Basin<D> basin;
  basin.c.forces = {{"box", ForceSurface::Of::obstacle, 0}};
  SurfaceForces<D> forces(basin.c);
  const auto& f = forces.measure(basin.water, 0.0);
  const double down = rho_g * 0.09 * 0.04 * Basin<D>::width;
  EXPECT_NEAR(f[0][0], 0.0, 1e-9 * down);
  EXPECT_NEAR(f[0][1], -down, 0.1 * down);
}

TYPED_TEST(SurfaceForcesOf, AConstantPressureIsFeltInFullAtEdges) {
  constexpr int D = TypeParam::value;
  Basin<D> basin;
  basin.fill([](double) { return 7.0; });
  basin.c.forces = {{"box", ForceSurface::Of::obstacle, 0}};
  SurfaceForces<D> forces(basin.c);
  EXPECT_NEAR(forces.measure(basin.water, 0.0)[0][1], -7.0 * 0.04 * Basin<D>::width, 1e-9);
}

TYPED_TEST(SurfaceForcesOf, AMovingWallIsFollowed) {
  constexpr int D = TypeParam::value;
  Basin<D> basin;
  MovingWall wall;
  wall.name = "piston";
  wall.box = {{-0.3, 0.0, 0.0}, {-0.1, 0.2, D == 3 ? 0.1 : 0.0}};
  wall.direction = {1.0, 0.0, 0.0};
  wall.law.kind = ScalarMotion::Kind::constant;
  wall.law.speed = 0.1;
  wall.law.stop = 10.0;
  basin.c.obstacles.clear();
  basin.c.tank.box.lower[0] = -0.3;
  basin.c.moving_walls = {wall};
  basin.fill([](double) { return 7.0; });
  basin.c.forces = {{"piston", ForceSurface::Of::moving_wall, 0}};
  SurfaceForces<D> forces(basin.c);
  EXPECT_EQ(forces.measure(basin.water, 0.0)[0][0], 0.0);
  // At t = 1 s its face is at x = 0, where the water begins; there is none above y = 0.15.
  const double full = -7.0 * 0.15 * Basin<D>::width;
  EXPECT_NEAR(forces.measure(basin.water, 1.0)[0][0], full, 0.05 * std::abs(full));
}

}  // namespace
}  // namespace surge
