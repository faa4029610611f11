#include <gtest/gtest.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::append;
using testing::dam_break;
using testing::lattice;

constexpr double l0 = 0.005;

ParticleFrame column() {
  ParticleFrame frame;
  frame.position = lattice({0, 0, 0}, {0.145, 0.29, 0}, l0);
  return frame;
}

double edge_of(const ParticleFrame& frame, const FrontOptions& options = {},
               const Physics& physics = dam_break()) {
  FrameView view = testing::view_of(frame, physics, l0);
  return leading_edge(view, options).value();
}

TEST(ParticleFront, OfTheColumnIsItsWidth) {
  EXPECT_NEAR(edge_of(column()), 0.145, 1e-12);
}

TEST(ParticleFront, FollowsAThinLayerOnTheFloor) {
  ParticleFrame frame = column();
  append(frame.position, lattice({0.145, 0, 0}, {0.3, 0.01, 0}, l0));
  EXPECT_NEAR(edge_of(frame), 0.3, 1e-12);
}

TEST(ParticleFront, LeavesDropsAheadOut) {
  ParticleFrame frame = column();
  append(frame.position, lattice({0.2, 0, 0}, {0.21, 0.01, 0}, l0));
  EXPECT_NEAR(edge_of(frame), 0.145, 1e-12);
  FrontOptions raw;
  raw.raw_maximum = true;
  EXPECT_NEAR(edge_of(frame, raw), 0.21, 1e-12);
}

TEST(ParticleFront, LinkingLengthDecidesWhatIsADrop) {
  ParticleFrame frame = column();
  frame.position.push_back({0.145 - l0 / 2 + 1.8 * l0, l0 / 2, 0});
  EXPECT_NEAR(edge_of(frame), 0.145 + 1.8 * l0, 1e-12);
  FrontOptions tight;
  tight.linking_length = 1.5;
  EXPECT_NEAR(edge_of(frame, tight), 0.145, 1e-12);
}

TEST(ParticleFront, LeavesWaterAboveTheStripOut) {
  ParticleFrame frame = column();
  append(frame.position,
         lattice({0.145, 0.1, 0}, {0.25, 0.15, 0}, l0));  // an overhang of the same body
  EXPECT_NEAR(edge_of(frame), 0.145, 1e-12);
  FrontOptions high;
  high.strip_height = Metres(0.2);
  EXPECT_NEAR(edge_of(frame, high), 0.25, 1e-12);
}

TEST(ParticleFront, CountsTheStripFromTheFloorOfTheTank) {
  ParticleFrame frame = column();
  append(frame.position, lattice({0.145, 0.0, 0}, {0.2, 0.01, 0}, l0));
  for (Vec3& x : frame.position) x[1] -= 0.5;
  Physics physics = dam_break();
  physics.tank->lower[1] = physics.column.lower[1] = -0.5;
  EXPECT_NEAR(edge_of(frame, {}, physics), 0.2, 1e-12);
}

TEST(ParticleFront, FollowsATongueThatTheWallHoldsOff) {
  // A layer whose lowest centres are 1.8 spacings above the floor, as SPH has it: a strip of one
  // and a half spacings would tell the column's edge behind it.
  ParticleFrame frame = column();
  append(frame.position, lattice({0.145, 1.3 * l0, 0}, {0.3, 2.3 * l0, 0}, l0));
  FrontOptions low;
  low.strip_height = Metres(1.5 * l0);
  EXPECT_NEAR(edge_of(frame, low), 0.3, 1e-12);
  EXPECT_NEAR(edge_of(frame), 0.3, 1e-12);
  const FrontStrip strip = front_strip(dam_break(), Metres(l0), true, low);
  EXPECT_NEAR(strip.upper, least_strip_spacings * l0, 1e-9);
  EXPECT_NEAR(front_strip(dam_break(), Metres(l0), false, low).upper, 1.5 * l0, 1e-7);
}

TEST(ParticleFront, WorksInThreeDimensionsWithZUp) {
  Physics physics = dam_break();
  physics.dimension = 3;
  physics.gravity = {0, 0, -9.81};
  physics.column = {{0, 0, 0}, {0.05, 0.03, 0.1}};
  physics.tank = Extent{{0, 0, 0}, {0.2, 0.03, 0.4}};
  ParticleFrame frame;
  frame.position = lattice({0, 0, 0}, {0.05, 0.03, 0.1}, l0);
  append(frame.position,
         lattice({0.05, 0.01, 0}, {0.09, 0.02, 0.01}, l0));  // a finger on the floor
  append(frame.position,
         lattice({0.05, 0.0, 0.05}, {0.12, 0.03, 0.06}, l0));  // a shelf above the strip
  append(frame.position, lattice({0.15, 0.0, 0}, {0.16, 0.03, 0.01}, l0));  // a drop ahead
  EXPECT_NEAR(edge_of(frame, {}, physics), 0.09, 1e-12);
}

TEST(ParticleFront, IsEmptyWhereTheMainBodyLeftTheFloor) {
  ParticleFrame frame;
  frame.position = lattice({0, 0.1, 0}, {0.1, 0.2, 0}, l0);
  append(frame.position, lattice({0.2, 0.0, 0}, {0.21, 0.01, 0}, l0));
  FrameView view = testing::view_of(frame, dam_break(), l0);
  EXPECT_FALSE(leading_edge(view, {}).has_value());
}

TEST(Front, InterpolatesAndNeverExtrapolates) {
  const DimensionlessFront front = testing::front_of({{0, 1}, {1, 2}, {2, 4}});
  EXPECT_DOUBLE_EQ(front.at(DimensionlessTime(1.5))->value(), 3.0);
  EXPECT_DOUBLE_EQ(front.at(DimensionlessTime(2))->value(), 4.0);
  EXPECT_FALSE(front.at(DimensionlessTime(-0.1)));
  EXPECT_FALSE(front.at(DimensionlessTime(2.1)));
  EXPECT_DOUBLE_EQ(front.arrival(DimensionlessLength(3))->value(), 1.5);
  EXPECT_FALSE(front.arrival(DimensionlessLength(4.1)));
  EXPECT_FALSE(front.arrival(DimensionlessLength(0.5)));
}

}  // namespace
}  // namespace surge::compare
