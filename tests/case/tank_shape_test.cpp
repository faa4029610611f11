#include "particle/case/tank_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "particle/case/case_file.hpp"
#include "particle/support/error.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/case/surface_fixture.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

/// Star-shaped around the middle of the unit square, within 0.1 to 0.9 of it.
ClosedSurface random_room(std::mt19937& random, int corners) {
  std::uniform_real_distribution<double> radius(0.1, 0.4);
  std::vector<Point> outline;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners, r = radius(random);
    outline.push_back({0.5 + r * std::cos(angle), 0.5 + r * std::sin(angle), 0.0});
  }
  return ClosedSurface::polygon(outline);
}

/// Room and bodies fill the box, and no place is in two of them.
void expect_to_fill(const ClosedSurface& room, const Box& box, std::size_t bodies) {
  const std::vector<ClosedSurface> around = bodies_around(room, box);
  EXPECT_EQ(around.size(), bodies);
  double volume = room.volume(), whole = 1.0;
  for (const ClosedSurface& body : around) volume += body.volume();
  for (std::size_t a = 0; a < static_cast<std::size_t>(room.dimension()); ++a)
    whole *= box.upper[a] - box.lower[a];
  EXPECT_NEAR(volume / whole, 1.0, 1e-12);
  std::mt19937 random(5);
  for (int k = 0; k < 1000; ++k) {
    Point x{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(room.dimension()); ++a)
      x[a] = std::uniform_real_distribution<double>(box.lower[a], box.upper[a])(random);
    int in = room.holds(x) ? 1 : 0;
    for (const ClosedSurface& body : around) in += body.holds(x) ? 1 : 0;
    EXPECT_EQ(in, 1) << x[0] << ' ' << x[1] << ' ' << x[2];
  }
}

TEST(TankShape, BodiesAboveAndBelowARoomThatTouchesNothing) {
  std::mt19937 random(1);
  const Box box{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}};
  for (int corners = 3; corners < 30; ++corners)
    expect_to_fill(random_room(random, corners), box, 2);
}

TEST(TankShape, BodiesInTheCornersThatARoomLeaves) {
  const Box box{{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}};
  // A V, a trapezium, an octagon, a room that ends in one upper corner, a diamond, a step.
  expect_to_fill(ClosedSurface::polygon({{1, 0, 0}, {2, 1, 0}, {0, 1, 0}}), box, 2);
  expect_to_fill(ClosedSurface::polygon({{0.5, 0, 0}, {1.5, 0, 0}, {2, 1, 0}, {0, 1, 0}}), box, 2);
  expect_to_fill(ClosedSurface::polygon({{0.5, 0, 0},
                                         {1.5, 0, 0},
                                         {2, 0.3, 0},
                                         {2, 0.7, 0},
                                         {1.5, 1, 0},
                                         {0.5, 1, 0},
                                         {0, 0.7, 0},
                                         {0, 0.3, 0}}),
                 box, 4);
  expect_to_fill(ClosedSurface::polygon({{0, 0, 0}, {2, 1, 0}, {0, 1, 0}}), box, 1);
  expect_to_fill(ClosedSurface::polygon({{1, 0, 0}, {2, 0.5, 0}, {1, 1, 0}, {0, 0.5, 0}}), box, 4);
  expect_to_fill(ClosedSurface::polygon(
                     {{0, 0.5, 0}, {1, 0.5, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}),
                 box, 1);
}

TEST(TankShape, OneBodyAroundARoomThatTouchesOneSide) {
  const Box box{{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}};
  for (const bool clockwise : {false, true}) {
    std::vector<Point> corners{{0.5, 1, 0}, {0.4, 0.2, 0}, {1.2, 0.1, 0}, {1.7, 1, 0}};
    if (clockwise) std::reverse(corners.begin(), corners.end());
    expect_to_fill(ClosedSurface::polygon(corners), box, 1);
  }
  // On the left, and at one corner of the room alone.
  expect_to_fill(ClosedSurface::polygon({{0, 0.2, 0}, {1, 0.4, 0}, {0, 0.8, 0}}), box, 1);
  expect_to_fill(ClosedSurface::polygon({{0, 0.5, 0}, {1, 0.2, 0}, {1, 0.8, 0}}), box, 2);
}

TEST(TankShape, NoBodyAroundTheBoxItself) {
  const Box box{{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}};
  EXPECT_TRUE(
      bodies_around(ClosedSurface::polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}),
                    box)
          .empty());
}

TEST(TankShape, ARoomInSpaceIsAHollow) {
  expect_to_fill(test::ball_surface({}, 0.4, 4), {{-0.5, -0.6, -0.7}, {0.8, 0.5, 0.5}}, 1);
}

TEST(TankShape, RoomsOutsideTheBoxAreRefused) {
  const auto fault = [](const ClosedSurface& room, const Box& box) -> std::string {
    try {
      static_cast<void>(bodies_around(room, box));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault(ClosedSurface::polygon({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}),
                  {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}),
            "found a room from x = 0 to 2, expected one in the tank's box, 0 to 1");
  EXPECT_EQ(fault(test::ball_surface({}, 0.5, 4), {{-0.5, -0.6, -0.7}, {0.8, 0.6, 0.6}}),
            "found a room from x = -0.5 to 0.5, expected one that touches no side of the tank's "
            "box, -0.5 to 0.8");
}

constexpr const char* vessel = R"(title = "Water in a V"
dimension = 2
[fluid]
density = 1000.0
gravity = [0.0, -9.81]
[tank]
polygon = [[0.3, 0.0], [0.6, 0.3], [0.0, 0.3]]
open = ["y+"]
[[block]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.6, 0.2]
[resolution]
spacing = 0.01
[time]
end = 0.2
[output]
interval = 0.1
[method]
name = "mps"
preset = "improved"
)";

std::string replaced(const std::string& what, const std::string& by) {
  std::string text = vessel;
  return text.replace(text.find(what), what.size(), by);
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse_computation(text, "v.toml", {}));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TankShape, TheCaseHasTheBoxAndItsBodies) {
  const Computation made = parse_computation(vessel, "v.toml", {});
  EXPECT_EQ(made.flow.tank.box.upper, (Point{0.6, 0.3, 0.0}));
  ASSERT_EQ(made.flow.obstacles.size(), 2U);
  EXPECT_DOUBLE_EQ(made.flow.obstacles[0].surface->volume(), 0.045);
  // What is written is the same case again.
  EXPECT_EQ(to_toml(parse_computation(to_toml(made), "w.toml", {})), to_toml(made));
}

TEST(TankShape, FaultsOfATankNameItsKeys) {
  EXPECT_THAT(refusal(replaced("[0.6, 0.3]", "[0.6, 0.0]")), HasSubstr("v.toml:"));
  EXPECT_THAT(refusal(replaced("open = [\"y+\"]", "open = [\"y+\", \"x-\"]")),
              HasSubstr("tank.open: found \"x-\", on which the room has no edge"));
  EXPECT_THAT(refusal(replaced("open = [\"y+\"]", "periodic = [\"x\"]")),
              HasSubstr("tank.periodic: found a room of its own shape besides"));
  EXPECT_THAT(refusal(replaced("[0.6, 0.3], [0.0, 0.3]]", "[0.6, 0.3], [0.0, 0.3], [0.6, 0.2]]")),
              HasSubstr("tank.polygon: found a surface that crosses"));
  EXPECT_THAT(refusal(replaced("polygon = ", "lower = [0.1, 0.0]\nupper = [0.6, 0.3]\npolygon = ")),
              HasSubstr("tank.polygon: found a room from x = 0 to 0.6"));
  EXPECT_THAT(refusal(replaced("upper = [0.6, 0.2]", "upper = [0.1, 0.05]")),
              HasSubstr("tank.polygon: found all of block.0 outside the room"));
}

}  // namespace
}  // namespace surge
