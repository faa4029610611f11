#include "particle/core/surface_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particle/core/initial_particles.hpp"
#include "particle/core/particle_count.hpp"
#include "particle/core/wall_collision.hpp"
#include "particle/core/wall_normals.hpp"
#include "tests/case/surface_fixture.hpp"

namespace surge {
namespace {

/// A tank 1 m x 1 m, half full, with one obstacle.
Case tank_with(Obstacle obstacle, int dimension = 2) {
  Case c;
  c.dimension = dimension;
  c.spacing = 0.05;
  c.has_tank = true;
  const double depth = dimension == 3 ? 0.5 : 0.0;
  c.tank.box = {{0.0, 0.0, 0.0}, {1.0, 1.0, depth}};
  c.tank.open[3] = true;
  FluidBlock block;
  block.box = {{0.0, 0.0, 0.0}, {0.4, 0.5, depth}};
  c.blocks = {block};
  c.obstacles = {std::move(obstacle)};
  return c;
}

const Point box_from{0.6, 0.0, 0.0}, box_to{0.9, 0.4, 0.0};

Obstacle polygon_of(const std::vector<Point>& corners) {
  return Obstacle(ClosedSurface::polygon(corners));
}
/// The same box as a polygon.
Obstacle box_polygon() {
  return polygon_of({box_from, {0.9, 0.0, 0.0}, box_to, {0.6, 0.4, 0.0}});
}

template <int D>
std::vector<std::array<double, 4>> sorted_walls(const Particles<D>& p) {
  std::vector<std::array<double, 4>> found;
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::array<double, 4> one{};
    for (std::size_t a = 0; a < D; ++a) one[a] = std::round(p.x[a][i] * 1e9) * 1e-9;
    one[3] = static_cast<double>(p.type[i]);
    found.push_back(one);
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(SurfaceWalls, PolygonThatIsABoxHasItsParticles) {
  const Case one = tank_with({box_from, box_to}), other = tank_with(box_polygon());
  for (const int layers : {1, 2, 4}) {
    const auto a = initial_particles<2>(one, layers), b = initial_particles<2>(other, layers);
    EXPECT_EQ(sorted_walls(a), sorted_walls(b)) << layers;
    EXPECT_EQ(count_particles(other, layers).all(), static_cast<double>(b.size()));
    EXPECT_EQ(count_particles(one, layers).wall, count_particles(other, layers).wall);
  }
}

TEST(SurfaceWalls, TrianglesThatAreABoxHaveItsParticles) {
  const Point from{0.6, 0.0, 0.1}, to{0.9, 0.4, 0.4};
  const Case one = tank_with({from, to}, 3);
  const Case other = tank_with(Obstacle(test::cube_surface(from, to)), 3);
  const auto a = initial_particles<3>(one, 2), b = initial_particles<3>(other, 2);
  EXPECT_EQ(sorted_walls(a), sorted_walls(b));
  EXPECT_EQ(count_particles(other, 2).all(), static_cast<double>(b.size()));
}

TEST(SurfaceWalls, FluidIsCutOutOfItsBlock) {
  // Of the 8 x 8 places around the triangle 1 + 2 + ... + 8 = 36 are under its long side or on it.
  const Case c = tank_with(polygon_of({{0.0, 0.0, 0.0}, {0.4, 0.0, 0.0}, {0.0, 0.4, 0.0}}));
  EXPECT_EQ(count_particles(c, 2).fluid, 80.0 - 36.0);
  const Particles<2> p = initial_particles<2>(c, 20);
  EXPECT_EQ(std::count(p.type.begin(), p.type.end(), ParticleType::fluid), 44);
  long inside = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.type[i] != ParticleType::fluid && p.x[0][i] > 0.0 && p.x[1][i] > 0.0 &&
        p.x[0][i] + p.x[1][i] < 0.4 + 1e-9)
      ++inside;
  EXPECT_EQ(inside, 36);
}

TEST(SurfaceWalls, CollisionsAreThoseOfTheBox) {
  const WallCollision<2> one(tank_with({box_from, box_to}), 0.01, 0.3);
  const WallCollision<2> other(tank_with(box_polygon()), 0.01, 0.3);
  for (int k = 0; k < 60; ++k) {
    const Vec<2> start{0.5, 0.05 + 0.005 * k};
    Vec<2> a{0.5 + 0.01 * k, 0.06 + 0.004 * k}, v{3.0, -1.0};
    Vec<2> b = a, w = v;
    EXPECT_EQ(one.apply(start, a, v), other.apply(start, b, w)) << k;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(a[i], b[i], 1e-12) << k;
      EXPECT_NEAR(v[i], w[i], 1e-12) << k;
    }
  }
}

TEST(SurfaceWalls, ParticleStopsBeforeAnInclinedFace) {
  const Case c = tank_with(polygon_of({{0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.5, 0.0}}));
  const WallCollision<2> walls(c, 0.02, 0.0);
  Vec<2> end{0.7, 0.1}, v{2.0, -2.0};  // straight onto the face of 45 degrees
  EXPECT_TRUE(walls.apply({0.55, 0.25}, end, v));
  // On the line that the path begins above, 0.02 m before the face.
  EXPECT_NEAR((end[1] - (end[0] - 0.5)) / std::sqrt(2.0), 0.02, 1e-12);
  EXPECT_NEAR(end[0] + end[1], 0.8, 1e-12);
  EXPECT_NEAR(std::hypot(v[0], v[1]), 0.0, 1e-12);
  // Along the face nothing is lost.
  Vec<2> far{0.8, 0.32 + 0.03}, u{1.0, 1.0};
  EXPECT_FALSE(walls.apply({0.6, 0.15}, far, u));
  EXPECT_FALSE(walls.is_solid({0.7, 0.21}));
  EXPECT_TRUE(walls.is_solid({0.7, 0.19}));
}

TEST(SurfaceWalls, FastParticleDoesNotPassACylinder) {
  std::vector<Point> corners;
  for (int k = 0; k < 64; ++k)
    corners.push_back({0.6 + 0.1 * std::cos(k * std::numbers::pi / 32),
                       0.5 + 0.1 * std::sin(k * std::numbers::pi / 32), 0});
  const WallCollision<2> walls(tank_with(polygon_of(corners)), 0.0, 0.0);
  Vec<2> end{0.9, 0.5}, v{30.0, 0.0};
  EXPECT_TRUE(walls.apply({0.45, 0.5}, end, v));
  EXPECT_NEAR(end[0], 0.5, 2e-3);
  EXPECT_FALSE(walls.is_lost(end));
}

TEST(SurfaceWalls, NormalsAreThoseOfTheNearestFreeFace) {
  const Case c = tank_with(polygon_of({{0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.5, 0.0}}));
  const Particles<2> p = initial_particles<2>(c, 3);
  const auto normals = wall_normals<2>(c, p);
  long seen = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    // In the wedge: floor and right wall cover its other faces.
    if (p.type[i] == ParticleType::fluid || p.x[1][i] < 0.0 || p.x[0][i] < 0.5 || p.x[0][i] > 1.0)
      continue;
    const Vec<2>& n = normals[static_cast<std::size_t>(p.id[i])];
    EXPECT_NEAR(std::abs(n[0] - n[1]), std::sqrt(2.0), 1e-9);
    ++seen;
  }
  EXPECT_GT(seen, 30);
}

TEST(SurfaceWalls, WallUnderABodyHasTheBodysFreeSurface) {
  const Case c = tank_with(polygon_of({{0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.5, 0.0}}));
  const WallCollision<2> walls(c, 0.0, 0.0);
  const auto place = walls.free_surface_of_wall({0.6, -0.025});
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place)[0], 0.55, 1e-12);
  EXPECT_NEAR((*place)[1], 0.05, 1e-12);
  const auto floor = walls.free_surface_of_wall({0.3, -0.025});
  ASSERT_TRUE(floor);
  EXPECT_EQ((*floor)[1], 0.0);
}

}  // namespace
}  // namespace surge
