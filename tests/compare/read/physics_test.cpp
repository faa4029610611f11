#include "compare/read/physics.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::dam_break;
using testing::error_of;
using ::testing::HasSubstr;
using ::testing::Not;

PhysicsComparison against_dam_break(const Physics& other) {
  return compare_physics(dam_break(), "a", other, "b");
}

TEST(Physics, SameCaseDiffersInNothing) {
  const PhysicsComparison comparison = against_dam_break(dam_break());
  EXPECT_TRUE(comparison.differences.empty());
  EXPECT_TRUE(comparison.not_stated.empty());
  EXPECT_NO_THROW(require_same_physics(comparison, {}));
}

struct Change {
  const char* key;
  void (*apply)(Physics&);
};

class PhysicsDifference : public ::testing::TestWithParam<Change> {};

TEST_P(PhysicsDifference, IsNamedAndRefusedUnlessAllowed) {
  Physics other = dam_break();
  GetParam().apply(other);
  const PhysicsComparison comparison = against_dam_break(other);
  ASSERT_EQ(comparison.differences.size(), 1U);
  EXPECT_EQ(comparison.differences[0].key, GetParam().key);
  EXPECT_THAT(error_of([&] { require_same_physics(comparison, {}); }),
              HasSubstr(std::string(GetParam().key) + ": "));
  EXPECT_NO_THROW(require_same_physics(comparison, {GetParam().key}));
}

INSTANTIATE_TEST_SUITE_P(
    Keys, PhysicsDifference,
    ::testing::Values(Change{"dimension", [](Physics& p) { p.dimension = 3; }},
                      Change{"gravity", [](Physics& p) { p.gravity[1] = -1.62; }},
                      Change{"column-width", [](Physics& p) { p.column.upper[0] = 0.146; }},
                      Change{"column-height", [](Physics& p) { p.column.upper[1] = 0.145; }},
                      Change{"tank-width", [](Physics& p) { p.tank->upper[0] = 0.6; }},
                      Change{"tank-height", [](Physics& p) { p.tank->upper[1] = 0.58; }},
                      Change{"density", [](Physics& p) { p.density = 998; }},
                      Change{"viscosity", [](Physics& p) { p.kinematic_viscosity = 1e-6; }},
                      Change{"wall", [](Physics& p) { p.wall = "no-slip"; }},
                      Change{"blocks",
                             [](Physics& p) {
                               p.blocks->push_back({"box", {{0.3, 0, 0}, {0.4, 0.1, 0}}, {}});
                             }},
                      Change{"blocks", [](Physics& p) { p.blocks->front().velocity[0] = 0.1; }},
                      Change{"blocks", [](Physics& p) { p.blocks->front().shape = "ball"; }},
                      Change{"obstacles",
                             [](Physics& p) {
                               p.obstacles->push_back({{0.3, 0, 0}, {0.33, 0.05, 0}});
                             }},
                      Change{"open", [](Physics& p) { p.open->clear(); }},
                      Change{"periodic", [](Physics& p) { p.periodic->insert("x"); }}));

TEST(Physics, OrderOfBodiesDoesNotMatter) {
  Physics a = dam_break(), b = dam_break();
  const WaterBody second{"box", {{0.3, 0, 0}, {0.4, 0.1, 0}}, {}};
  a.blocks->push_back(second);
  b.blocks->insert(b.blocks->begin(), second);
  EXPECT_TRUE(compare_physics(a, "a", b, "b").differences.empty());
}

TEST(Physics, BodiesThatOneSideDoesNotStateAreListed) {
  Physics other = dam_break();
  other.blocks.reset();
  other.obstacles.reset();
  const PhysicsComparison comparison = against_dam_break(other);
  EXPECT_THAT(comparison.not_stated, ::testing::ElementsAre("blocks", "obstacles"));
}

TEST(Physics, AllDifferencesAreNamedAtOnce) {
  Physics other = dam_break();
  other.density = 900;
  other.wall = "no-slip";
  const std::string message = error_of([&] { require_same_physics(against_dam_break(other), {}); });
  EXPECT_THAT(message, HasSubstr("density: 1000 kg/m3 in a, 900 kg/m3 in b"));
  EXPECT_THAT(message, HasSubstr("wall: slip in a, no-slip in b"));
  EXPECT_THAT(error_of([&] { require_same_physics(against_dam_break(other), {"wall"}); }),
              Not(HasSubstr("wall: slip")));
}

TEST(Physics, WhatIsNotStatedIsListedAndNoDifference) {
  Physics other = dam_break();
  other.density.reset();
  other.tank.reset();
  const PhysicsComparison comparison = against_dam_break(other);
  EXPECT_TRUE(comparison.differences.empty());
  EXPECT_THAT(comparison.not_stated,
              ::testing::UnorderedElementsAre("density", "tank-width", "tank-height"));
}

TEST(Physics, UnknownKeyToAllowIsAnError) {
  EXPECT_THAT(error_of([] { require_same_physics({}, {"colour"}); }),
              HasSubstr("\"colour\" found"));
}

TEST(Physics, GravityMustPointDown) {
  Physics physics = dam_break();
  EXPECT_EQ(physics.vertical_axis(), 1);
  physics.gravity = {0, 0, -9.81};
  EXPECT_EQ(physics.vertical_axis(), 2);
  for (const Vec3 bad : {Vec3{-9.81, 0, 0}, Vec3{0, 9.81, 0}, Vec3{1, -9, 0}, Vec3{0, 0, 0}}) {
    physics.gravity = bad;
    EXPECT_THROW((void)physics.vertical_axis(), Error);
  }
}

}  // namespace
}  // namespace surge::compare
