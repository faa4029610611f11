#include "compare/figures/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

constexpr double l0 = 0.05;  // over L

WaterPicture lattice(int columns, int rows) {
  WaterPicture picture;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      picture.patches.push_back({(i + 0.5) * l0, (j + 0.5) * l0, 0.5 * l0, 0.5 * l0, 0.0});
  return picture;
}

Solids tank(double width, double height) {
  Solids solids;
  solids.tank = Rectangle{0.0, 0.0, width, height};
  solids.up_side = "y+";
  return solids;
}

double length_of(const std::vector<Segment>& lines) {
  double sum = 0.0;
  for (const Segment& s : lines) sum += std::hypot(s.x1 - s.x0, s.y1 - s.y0);
  return sum;
}

TEST(FreeSurface, OfALatticeInACornerLiesHalfASpacingBeyondItsOuterParticles) {
  // 1 x 2 of water in the lower left corner: the line is its top and its right side.
  const auto lines = free_surface(lattice(20, 40), tank(4.0, 4.0), Seconds(0.0));
  ASSERT_FALSE(lines.empty());
  for (const Segment& s : lines) {
    const double x = 0.5 * (s.x0 + s.x1), y = 0.5 * (s.y0 + s.y1);
    const double off = std::min(std::abs(x - 1.0), std::abs(y - 2.0));
    EXPECT_LT(off, 0.5 * l0) << x << ' ' << y;
    // Away from the corner it is exact.
    if (x < 1.0 - 2.0 * l0) {
      EXPECT_NEAR(y, 2.0, 1e-9);
    }
    if (y < 2.0 - 2.0 * l0) {
      EXPECT_NEAR(x, 1.0, 1e-9);
    }
  }
  EXPECT_NEAR(length_of(lines), 3.0, 2.0 * l0);
}

TEST(FreeSurface, OfAFullTankThereIsNone) {
  EXPECT_TRUE(free_surface(lattice(20, 20), tank(1.0, 1.0), Seconds(0.0)).empty());
}

TEST(FreeSurface, OpensAtAnOpenSide) {
  Solids solids = tank(1.0, 1.0);
  solids.open = {"y+"};
  const auto lines = free_surface(lattice(20, 20), solids, Seconds(0.0));
  ASSERT_FALSE(lines.empty());
  for (const Segment& s : lines) EXPECT_NEAR(s.y0, 1.0, 1e-9);
}

TEST(FreeSurface, IsNotDrawnAlongAWallThatMovesAndFollowsIt) {
  Solids solids = tank(4.0, 4.0);
  Solids::MovingWall gate{{1.0, 0.0, 1.1, 3.0}, 0.0, 1.0, {}, 0.2};
  gate.law.kind = ScalarMotion::Kind::constant;
  gate.law.speed = 2.0;  // m/s: 10 L/s upwards
  gate.law.stop = 1.0;
  solids.walls.push_back(gate);
  const double all = length_of(free_surface(lattice(20, 40), tank(4.0, 4.0), Seconds(0.0)));
  const double closed = length_of(free_surface(lattice(20, 40), solids, Seconds(0.0)));
  EXPECT_NEAR(all - closed, 2.0, 3.0 * l0);
  EXPECT_NEAR(length_of(free_surface(lattice(20, 40), solids, Seconds(0.5))), all, 1e-9);
  EXPECT_NEAR(solids.walls[0].at(Seconds(0.1)).y0, 1.0, 1e-12);
}

TEST(Solids, AreThoseOfTheManifestOverTheWidthOfTheColumn) {
  compare::Run run;
  run.physics = testing::dam_break();
  run.physics.obstacles = std::vector<SolidBody>{{{0.29, 0.0, 0.0}, {0.3625, 0.0725, 0.0}}};
  run.physics.moving_walls =
      nlohmann::json::array({{{"lower", {0.145, 0.0, 0.0}},
                              {"upper", {0.1595, 0.29, 0.0}},
                              {"direction", {0.0, 1.0, 0.0}},
                              {"law", "constant"},
                              {"speed", 1.45},
                              {"start", 0.0},
                              {"stop", 0.2}},
                             {{"lower", {0, 0, 0}}, {"upper", {1, 1, 0}}, {"law", "by hand"}}});
  const Solids solids = solids_of(run);
  ASSERT_EQ(solids.obstacles.size(), 1U);
  EXPECT_NEAR(solids.obstacles[0].x0, 2.0, 1e-12);
  EXPECT_NEAR(solids.obstacles[0].y1, 0.5, 1e-12);
  ASSERT_EQ(solids.walls.size(), 1U);
  EXPECT_EQ(solids.not_drawn, 1U);
  EXPECT_NEAR(solids.walls[0].at(Seconds(0.1)).y0, 1.0, 1e-12);
  EXPECT_NEAR(solids.walls[0].at(Seconds(9.0)).y1, 4.0, 1e-12);
  EXPECT_NEAR(solids.tank->x1, 4.0, 1e-12);
}

TEST(Solids, InThreeDimensionsAreThoseThatTheMiddlePlaneCuts) {
  compare::Run run;
  run.physics = testing::dam_break();
  run.physics.dimension = 3;
  run.physics.tank->upper[2] = 0.4;
  run.physics.column.upper[2] = 0.4;
  run.physics.obstacles = std::vector<SolidBody>{{{0.29, 0.0, 0.15}, {0.3, 0.1, 0.25}},
                                                 {{0.4, 0.0, 0.0}, {0.5, 0.1, 0.1}}};
  const Solids solids = solids_of(run);
  ASSERT_EQ(solids.obstacles.size(), 1U);
  EXPECT_NEAR(solids.obstacles[0].x0, 2.0, 1e-12);
}

}  // namespace
}  // namespace surge::compare
