#include "particle/case/closed_surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "particle/support/error.hpp"
#include "tests/case/surface_fixture.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

std::string fault_of(const std::function<ClosedSurface()>& make) {
  try {
    static_cast<void>(make());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string polygon_fault(const std::vector<Point>& corners) {
  return fault_of([&] { return ClosedSurface::polygon(corners); });
}

TEST(ClosedSurface, TriangleInThePlaneHasItsSizesAndDistances) {
  const ClosedSurface wedge = ClosedSurface::polygon({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  EXPECT_DOUBLE_EQ(wedge.volume(), 2.0);
  EXPECT_DOUBLE_EQ(wedge.area(), 4.0 + 2.0 * std::numbers::sqrt2);
  const NearestPlace face = wedge.nearest({2, 2, 0});
  EXPECT_DOUBLE_EQ(face.distance, std::numbers::sqrt2);
  EXPECT_NEAR(face.place[0], 1.0, 1e-15);
  EXPECT_NEAR(face.normal[1], std::sqrt(0.5), 1e-15);
  EXPECT_DOUBLE_EQ(wedge.distance({0.5, 0.5, 0}), -0.5);
  EXPECT_DOUBLE_EQ(wedge.distance({-3, -4, 0}), 5.0);  // a corner
  EXPECT_DOUBLE_EQ(wedge.distance({1, 0, 0}), 0.0);
  EXPECT_NEAR(wedge.nearest({0.3, 0, 0}).normal[1], -1.0, 1e-15);
}

TEST(ClosedSurface, SenseOfAPolygonDoesNotMatter) {
  const ClosedSurface one = ClosedSurface::polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const ClosedSurface other = ClosedSurface::polygon({{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}});
  EXPECT_DOUBLE_EQ(other.volume(), 1.0);
  for (const Point& x : {Point{0.3, 0.4, 0}, Point{1.5, 0.5, 0}, Point{-1, -1, 0}})
    EXPECT_DOUBLE_EQ(one.distance(x), other.distance(x));
}

TEST(ClosedSurface, ReflexCornerOfAnLHasOneSideInside) {
  const ClosedSurface l =
      ClosedSurface::polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  EXPECT_DOUBLE_EQ(l.volume(), 3.0);
  EXPECT_DOUBLE_EQ(l.distance({0.7, 0.6, 0}), -0.5);
  EXPECT_NEAR(l.distance({1.2, 1.1, 0}), 0.1, 1e-15);
  EXPECT_TRUE(l.holds({0.9, 0.9, 0}));
  EXPECT_FALSE(l.holds({1.1, 1.1, 0}));
}

TEST(ClosedSurface, CircleOfManySidesIsOneToTheSagOfItsSides) {
  const int sides = 2000;
  std::vector<Point> corners;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / sides;
    corners.push_back({3.0 + 0.5 * std::cos(angle), 1.0 + 0.5 * std::sin(angle), 0.0});
  }
  const ClosedSurface circle = ClosedSurface::polygon(corners);
  for (int k = 0; k < 100; ++k) {
    const Point x{2.0 + 0.02 * k, 0.3 + 0.013 * k, 0.0};
    EXPECT_NEAR(circle.distance(x), std::hypot(x[0] - 3.0, x[1] - 1.0) - 0.5, 1e-6);
  }
}

TEST(ClosedSurface, CubeInSpaceHasItsSizesAndDistances) {
  const ClosedSurface cube = test::cube_surface({1, 2, 3}, {2, 4, 6});
  EXPECT_NEAR(cube.volume(), 6.0, 1e-13);
  EXPECT_NEAR(cube.area(), 22.0, 1e-13);
  EXPECT_DOUBLE_EQ(cube.distance({1.5, 2.25, 4}), -0.25);
  EXPECT_DOUBLE_EQ(cube.distance({1.5, 4.5, 4}), 0.5);
  EXPECT_DOUBLE_EQ(cube.distance({-2, -2, 4}), 5.0);             // an edge
  EXPECT_NEAR(cube.distance({3, 5, 7}), std::sqrt(3.0), 1e-15);  // a corner
  EXPECT_EQ(cube.nearest({1.5, 4.5, 4}).normal, (Point{0, 1, 0}));
  EXPECT_NEAR(cube.share_of({{0, 2, 3}, {2, 4, 6}}), 0.5, 1e-12);
}

TEST(ClosedSurface, SphereOfTrianglesIsOneToTheirSag) {
  const ClosedSurface ball = test::ball_surface({0.5, 0.5, 0.5}, 0.4, 40);
  EXPECT_NEAR(ball.volume() / (4.0 / 3.0 * std::numbers::pi * 0.064), 1.0, 0.01);
  for (int k = 0; k < 200; ++k) {
    const Point x{0.005 * k, std::fmod(0.37 * k, 1.0), std::fmod(0.73 * k, 1.0)};
    const double exact = std::hypot(x[0] - 0.5, x[1] - 0.5, x[2] - 0.5) - 0.4;
    EXPECT_NEAR(ball.distance(x), exact, 2e-3);
  }
}

TEST(ClosedSurface, ShareOfABoxIsExactInThePlane) {
  const ClosedSurface wedge = ClosedSurface::polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  EXPECT_NEAR(wedge.share_of({{0, 0, 0}, {1, 1, 0}}), 0.5, 1e-15);
  EXPECT_NEAR(wedge.share_of({{0.5, 0.25, 0}, {2, 0.75, 0}}),
              (0.5 * 0.5 - 0.25 * 0.25 / 2) / (1.5 * 0.5), 1e-15);
  EXPECT_EQ(wedge.share_of({{2, 0, 0}, {3, 1, 0}}), 0.0);
}

TEST(ClosedSurface, WhatIsNoSimplePolygonIsRefused) {
  EXPECT_THAT(polygon_fault({{0, 0, 0}, {1, 1, 0}}), HasSubstr("found 2 corners"));
  EXPECT_THAT(polygon_fault({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}),
              HasSubstr("crosses or touches itself"));
  EXPECT_THAT(polygon_fault({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), HasSubstr("touches itself"));
  EXPECT_THAT(polygon_fault({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}}), HasSubstr("twice"));
  // A corner on an edge, and an edge there and back.
  EXPECT_THAT(polygon_fault({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}),
              HasSubstr("touches itself"));
  EXPECT_THAT(polygon_fault({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 1, 0}, {0, 1, 0}}),
              HasSubstr("touches itself"));
  EXPECT_EQ(polygon_fault({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.1, 0}, {0, 2, 0}}), "");
}

TEST(ClosedSurface, TrianglesThatHoldNoBodyAreRefused) {
  const test::Triangles cube = test::cube_triangles({0, 0, 0}, {1, 1, 1});
  const auto& vertices = cube.first;
  const auto& facets = cube.second;
  auto open = facets, turned = facets, inwards = facets;
  open.pop_back();
  std::swap(turned[3][0], turned[3][1]);
  for (auto& facet : inwards) std::swap(facet[0], facet[1]);
  const auto fault = [&](const std::vector<ClosedSurface::Facet>& of) {
    return fault_of([&] { return ClosedSurface::triangles(vertices, of); });
  };
  EXPECT_EQ(fault(facets), "");
  EXPECT_THAT(fault(open), HasSubstr("a surface that is open"));
  EXPECT_THAT(fault(turned), HasSubstr("face opposite ways"));
  EXPECT_THAT(fault(inwards), HasSubstr("face inwards (a volume of -"));
  EXPECT_THAT(fault({facets[0], facets[1]}), HasSubstr("2 triangles"));
  // Two cubes that overlap by a corner.
  auto both = vertices;
  auto all = facets;
  const auto [more, others] = test::cube_triangles({0.5, 0.45, 0.4}, {1.5, 1.45, 1.4});
  both.insert(both.end(), more.begin(), more.end());
  for (auto facet : others) {
    for (auto& corner : facet) corner += 8;
    all.push_back(facet);
  }
  EXPECT_THAT(fault_of([&] { return ClosedSurface::triangles(both, all); }),
              HasSubstr("crosses or touches itself"));
}

}  // namespace
}  // namespace surge
