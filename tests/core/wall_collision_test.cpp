#include <gtest/gtest.h>

#include <random>

#include "particle/core/wall_collision.hpp"

namespace surge {
namespace {

Case tank_with_thin_obstacle() {
  Case c;
  c.has_tank = true;
  c.tank.box = {{0.0, 0.0, 0.0}, {1.0, 2.0, 0.0}};
  c.tank.open[3] = true;
  c.obstacles = {{{0.5, 0.0, 0.0}, {0.51, 0.4, 0.0}}};
  return c;
}

TEST(WallCollision, StopsAtTheWallWithoutRestitution) {
  const WallCollision<2> walls(tank_with_thin_obstacle(), 0.01, 0.0);
  Vec<2> end{-0.3, 0.5};
  Vec<2> v{-10.0, 2.0};
  EXPECT_TRUE(walls.apply({0.1, 0.3}, end, v));
  EXPECT_DOUBLE_EQ(end[0], 0.01);
  EXPECT_DOUBLE_EQ(end[1], 0.5);
  EXPECT_DOUBLE_EQ(v[0], 0.0);
  EXPECT_DOUBLE_EQ(v[1], 2.0);
}

TEST(WallCollision, ReflectsWithRestitution) {
  const WallCollision<2> walls(tank_with_thin_obstacle(), 0.0, 0.5);
  Vec<2> end{0.2, -0.1};
  Vec<2> v{0.0, -4.0};
  EXPECT_TRUE(walls.apply({0.2, 0.1}, end, v));
  EXPECT_DOUBLE_EQ(end[1], 0.05);
  EXPECT_DOUBLE_EQ(v[1], 2.0);
}

// The point of looking at the trajectory: the end alone would be on the other side, in free space.
TEST(WallCollision, FastParticleDoesNotJumpOverAThinObstacle) {
  const WallCollision<2> walls(tank_with_thin_obstacle(), 0.005, 0.0);
  Vec<2> end{0.9, 0.2};
  Vec<2> v{800.0, 0.0};
  EXPECT_TRUE(walls.apply({0.1, 0.2}, end, v));
  EXPECT_NEAR(end[0], 0.495, 1e-12);
  EXPECT_EQ(v[0], 0.0);
  end = {0.9, 0.8};
  v = {800.0, 0.0};
  EXPECT_FALSE(walls.apply({0.1, 0.8}, end, v)) << "above the obstacle the way is free";
}

TEST(WallCollision, FreeMotionIsLeftAlone) {
  const WallCollision<2> walls(tank_with_thin_obstacle(), 0.01, 0.3);
  Vec<2> end{0.3, 1.9};
  Vec<2> v{1.0, 1.0};
  EXPECT_FALSE(walls.apply({0.2, 1.5}, end, v));
  EXPECT_EQ(end, (Vec<2>{0.3, 1.9}));
  end[1] = 2.5;
  EXPECT_FALSE(walls.apply({0.2, 1.5}, end, v)) << "the open side is no wall";
  EXPECT_TRUE(walls.is_lost(end));
}

TEST(WallCollision, ParticleInsideAnObstacleIsPushedOut) {
  const WallCollision<2> walls(tank_with_thin_obstacle(), 0.0, 0.0);
  Vec<2> end{0.502, 0.1};
  Vec<2> v{0.0, 0.0};
  EXPECT_TRUE(walls.apply({0.503, 0.1}, end, v));
  EXPECT_FALSE(walls.is_lost(end));
}

TEST(WallCollision, ObstaclesAndWhatIsBeyondWallsAreSolid) {
  const WallCollision<2> walls(tank_with_thin_obstacle(), 0.1, 0.0);
  EXPECT_TRUE(walls.is_solid({-0.001, 0.5}));
  EXPECT_TRUE(walls.is_solid({0.2, -0.001}));
  EXPECT_TRUE(walls.is_solid({0.502, 0.1}));
  EXPECT_FALSE(walls.is_solid({0.2, 2.5})) << "the open side is no wall";
  EXPECT_FALSE(walls.is_solid({0.001, 0.001})) << "the distance is for particles";
}

// Whatever the path, however fast: nobody ends up outside, inside a solid, or behind it.
TEST(WallCollision, NoRandomPathPassesAWall) {
  Case c = tank_with_thin_obstacle();
  c.tank.open[3] = false;
  c.obstacles[0].upper[1] = 2.0;  // divides the tank in two
  const WallCollision<2> walls(c, 0.003, 0.7);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> where(0.01, 0.48);
  std::uniform_real_distribution<double> height(0.01, 1.99);
  std::normal_distribution<double> path(0.0, 3.0);
  for (int k = 0; k < 20000; ++k) {
    const Vec<2> start{where(random), height(random)};
    Vec<2> v{path(random), path(random)};
    Vec<2> end{start[0] + v[0], start[1] + v[1]};
    walls.apply(start, end, v);
    ASSERT_FALSE(walls.is_lost(end))
        << start[0] << ' ' << start[1] << " -> " << end[0] << ' ' << end[1];
    ASSERT_LT(end[0], 0.5) << "passed the dividing wall";
  }
}

// Beneath the floor, in a corner, beneath a box on the floor, in that box, beneath a piston.
TEST(WallCollision, FreeSurfaceOfAWallIsWhereWaterCanBe) {
  Case c = tank_with_thin_obstacle();
  c.obstacles = {{{0.5, 0.0, 0.0}, {0.7, 0.4, 0.0}}};
  c.moving_walls.push_back({"piston", {{0.0, 0.0, 0.0}, {0.1, 2.0, 0.0}}, {1.0, 0.0, 0.0}, {}});
  c.moving_walls.back().law.kind = ScalarMotion::Kind::constant;
  c.moving_walls.back().law.speed = 0.1;
  c.moving_walls.back().law.stop = 10.0;
  WallCollision<2> walls(c, 0.0, 0.0);
  walls.move_walls(0.0, 1.0);  // the piston's face is at 0.2
  const auto expect = [&](Vec<2> x, Vec<2> surface) {
    const auto found = walls.free_surface_of_wall(x);
    ASSERT_TRUE(found.has_value()) << x[0] << ", " << x[1];
    EXPECT_NEAR((*found)[0], surface[0], 1e-12) << x[0] << ", " << x[1];
    EXPECT_NEAR((*found)[1], surface[1], 1e-12) << x[0] << ", " << x[1];
  };
  expect({0.3, -0.02}, {0.3, 0.0});
  expect({1.03, -0.02}, {1.0, 0.0});
  expect({1.03, 0.7}, {1.0, 0.7});
  expect({0.69, -0.01}, {0.7, 0.0});
  expect({0.69, 0.005}, {0.7, 0.005});
  expect({0.6, 0.39}, {0.6, 0.4});
  expect({0.19, -0.01}, {0.2, 0.0});
  expect({0.17, 0.02}, {0.2, 0.02});
}

TEST(WallCollision, WhatReachesAPeriodicSideGoesOnBehindIt) {
  Case c;
  c.dimension = 3;
  c.has_tank = true;
  c.tank.box = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.1}};
  c.tank.periodic[2] = true;
  c.obstacles = {{{0.4, 0.0, 0.0}, {0.6, 0.5, 0.1}}};
  const WallCollision<3> walls(c, 0.0, 0.0);
  const auto in_box = walls.free_surface_of_wall({0.55, 0.2, 0.01});
  ASSERT_TRUE(in_box.has_value());
  EXPECT_EQ(*in_box, (Vec<3>{0.6, 0.2, 0.01}));
  const auto below = walls.free_surface_of_wall({0.55, -0.01, 0.01});
  ASSERT_TRUE(below.has_value());
  EXPECT_EQ(*below, (Vec<3>{0.6, 0.0, 0.01}));
}

TEST(WallCollision, ABoxBetweenOthersHasNoFreeSurface) {
  Case c;
  c.dimension = 2;
  c.has_tank = true;
  c.tank.box = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}};
  c.obstacles = {{{0.0, 0.0, 0.0}, {0.5, 1.0, 0.0}}, {{0.5, 0.0, 0.0}, {1.0, 1.0, 0.0}}};
  const WallCollision<2> walls(c, 0.0, 0.0);
  EXPECT_FALSE(walls.free_surface_of_wall({0.45, 0.5}).has_value());
}

}  // namespace
}  // namespace surge
