#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "particle/case/case_file.hpp"
#include "particle/support/error.hpp"
#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

/// The small case with a polygon in the place of its obstacle.
std::string with_polygon(const std::string& corners, const std::string& more = "") {
  std::string text = test::small_case;
  const auto begin = text.find("lower = [0.1, 0.0]");
  const auto end = text.find("[[probe]]");
  return text.replace(begin, end - begin, "polygon = " + corners + "\n" + more);
}

std::string polygon_refusal(const std::string& corners, const std::string& more = "") {
  try {
    static_cast<void>(parse_computation(with_polygon(corners, more), "small.toml", {}));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string ring(double x, double y, double radius, int sides) {
  std::ostringstream text;
  text << '[';
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / sides;
    text << (k > 0 ? ", [" : "[") << x + radius * std::cos(angle) << ", "
         << y + radius * std::sin(angle) << ']';
  }
  return text.str() + ']';
}

TEST(SurfaceChecks, PolygonIsReadAndWrittenInFull) {
  const Computation made =
      parse_computation(with_polygon("[[0.06, 0.0], [0.12, 0.0], [0.12, 0.05]]"), "a.toml", {});
  const Obstacle& wedge = made.flow.obstacles.at(0);
  ASSERT_TRUE(wedge.surface);
  EXPECT_EQ(wedge.upper, (Point{0.12, 0.05, 0.0}));
  EXPECT_DOUBLE_EQ(wedge.surface->volume(), 0.0015);
  EXPECT_THAT(to_toml(made), HasSubstr("polygon = [[0.06,0.0],[0.12,0.0],[0.12,0.05]]"));
  EXPECT_EQ(to_toml(parse_computation(to_toml(made), "b.toml", {})), to_toml(made));
}

TEST(SurfaceChecks, FaultsNameFileLineAndKey) {
  EXPECT_THAT(polygon_refusal("[[0.06, 0.0], [0.12, 0.05], [0.12, 0.0], [0.06, 0.05]]"),
              HasSubstr("small.toml:19: obstacle.0.polygon: found a surface that crosses"));
  EXPECT_THAT(polygon_refusal("[[0.06, 0.0], [0.12, nan], [0.12, 0.05]]"),
              HasSubstr("obstacle.0.polygon"));
  EXPECT_THAT(polygon_refusal("[[0.06, 0.0], [0.13, 0.0], [0.12, 0.05]]"),
              HasSubstr("polygon: found x = 0.13, expected the obstacle inside the tank"));
  EXPECT_THAT(polygon_refusal("[[0.06, 0.0], [0.12, 0.0], [0.12, 0.05]]", "lower = [0.0, 0.0]\n"),
              HasSubstr("another body besides"));
  EXPECT_THAT(polygon_refusal("[[0.06, 0.0], [0.12, 0.0], [0.12, 0.05]]", "scale = 2.0\n"),
              HasSubstr("scale"));
}

TEST(SurfaceChecks, BodyThinnerThanTheRadiusIsRefused) {
  // The radius is 0.036 m. An inclined plate with water on both sides, and a ring.
  EXPECT_THAT(polygon_refusal("[[0.05, 0.0], [0.07, 0.0], [0.1, 0.1], [0.08, 0.1]]"),
              HasSubstr("m thick with room for water on both sides, expected at least 0.036 m"));
  EXPECT_THAT(polygon_refusal(ring(0.085, 0.06, 0.012, 24)), HasSubstr("thick"));
  EXPECT_EQ(polygon_refusal(ring(0.085, 0.06, 0.02, 24)), "");
  // A flat ramp has water on one side; a tip of less than 20 degrees has it on both.
  EXPECT_EQ(polygon_refusal("[[0.05, 0.0], [0.12, 0.0], [0.12, 0.01]]"), "");
  EXPECT_THAT(polygon_refusal("[[0.05, 0.05], [0.115, 0.045], [0.115, 0.055]]"),
              HasSubstr("thick"));
}

TEST(SurfaceChecks, GapsThatHoldNoParticleAreRefused) {
  EXPECT_THAT(polygon_refusal(ring(0.085, 0.025, 0.02, 24)),
              HasSubstr("a gap of 0.005 m to the tank's wall"));
  EXPECT_EQ(polygon_refusal(ring(0.085, 0.02, 0.02, 24)), "");  // it lies on the floor
  EXPECT_THAT(polygon_refusal("[[0.042, 0.0], [0.079, 0.0], [0.079, 0.05], [0.083, 0.05], [0.083, "
                              "0.0], [0.12, 0.0], [0.12, 0.09], [0.042, 0.09]]"),
              HasSubstr("a gap of 0.004 m to itself"));
}

TEST(SurfaceChecks, SolidsMayTouchAndNotOverlap) {
  const std::string wedge = "[[0.05, 0.0], [0.09, 0.0], [0.09, 0.04]]";
  const std::string box = "[[obstacle]]\nlower = [0.09, 0.0]\nupper = [0.12, 0.04]\n";
  const std::string deeper = "[[obstacle]]\nlower = [0.08, 0.0]\nupper = [0.12, 0.04]\n";
  EXPECT_EQ(polygon_refusal(wedge, box), "");
  EXPECT_THAT(polygon_refusal(wedge, deeper),
              HasSubstr("obstacle.0.polygon: found an overlap with obstacle.1"));
  // What is free of the box around the wedge is no part of it: they touch at the inclined face.
  EXPECT_EQ(polygon_refusal(wedge,
                            "[[obstacle]]\npolygon = [[0.05, 0.0], [0.09, 0.04], [0.09, "
                            "0.06], [0.05, 0.06]]\n"),
            "");
}

TEST(SurfaceChecks, BlockThatABodyFillsIsRefused) {
  EXPECT_THAT(polygon_refusal("[[0.0, 0.0], [0.05, 0.0], [0.05, 0.09], [0.0, 0.09]]"),
              HasSubstr("obstacle.0.polygon: found all of block.0 inside it"));
}

TEST(SurfaceChecks, ProbesLieOutsideOrOnTheSurface) {
  std::string text = with_polygon("[[0.06, 0.0], [0.12, 0.0], [0.12, 0.06]]");
  const auto at = [&](const std::string& place) -> std::string {
    try {
      static_cast<void>(parse_computation(text, "small.toml",
                                          std::vector<std::string>{"probe.0.position=" + place}));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(at("[0.09, 0.03]"), "");
  EXPECT_EQ(at("[0.08, 0.03]"), "");
  EXPECT_THAT(at("[0.1, 0.03]"), HasSubstr("a place inside obstacle.0"));
}

}  // namespace
}  // namespace surge
