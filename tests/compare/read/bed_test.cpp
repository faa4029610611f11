#include <gtest/gtest.h>

#include "compare/read/physics.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

WaterBody box(const Vec3& lower, const Vec3& upper) {
  return {"box", {lower, upper}, {}};
}

/// A column 0.2 m x 0.2 m in a tank 0.8 m x 0.4 m, and more water.
Physics with(std::vector<WaterBody> blocks) {
  Physics physics = testing::dam_break();
  physics.tank = Extent{{0, 0, 0}, {0.8, 0.4, 0}};
  physics.blocks = std::move(blocks);
  physics.column = (*physics.blocks)[column_among_blocks(physics)].box;
  return physics;
}

const WaterBody column = box({0, 0, 0}, {0.2, 0.2, 0});

TEST(BedDepth, OfADryFloorIsZero) {
  EXPECT_EQ(with({column}).bed_depth(), Metres(0.0));
}

TEST(BedDepth, OfALayerBesideTheColumnOrUnderItInAnyOrder) {
  const WaterBody beside = box({0.2, 0, 0}, {0.8, 0.02, 0});
  const WaterBody under = box({0, 0, 0}, {0.8, 0.02, 0});
  for (const auto& blocks : std::vector<std::vector<WaterBody>>{
           {column, beside}, {beside, column}, {column, under}, {under, column}}) {
    const Physics physics = with(blocks);
    EXPECT_EQ(physics.bed_depth(), Metres(0.02));
    EXPECT_NEAR(physics.column_width().value(), 0.2, 1e-12);
    EXPECT_EQ(physics.surge_direction(), 1.0);
  }
}

TEST(BedDepth, OfAColumnAtTheUpperWall) {
  const Physics physics = with({box({0, 0, 0}, {0.6, 0.02, 0}), box({0.6, 0, 0}, {0.8, 0.2, 0})});
  EXPECT_EQ(physics.bed_depth(), Metres(0.02));
  EXPECT_EQ(physics.surge_direction(), -1.0);
  EXPECT_NEAR(physics.column_width().value(), 0.2, 1e-12);
}

TEST(BedDepth, OfWaterThatLeavesFloorDryIsZero) {
  EXPECT_EQ(with({column, box({0.5, 0, 0}, {0.8, 0.02, 0})}).bed_depth(), Metres(0.0));
  EXPECT_EQ(with({column, box({0.2, 0.1, 0}, {0.8, 0.12, 0})}).bed_depth(), Metres(0.0));
  // Two depths are no bed.
  EXPECT_EQ(with({column, box({0.2, 0, 0}, {0.5, 0.02, 0}), box({0.5, 0, 0}, {0.8, 0.03, 0})})
                .bed_depth(),
            Metres(0.0));
}

TEST(BedDepth, OfALayerAroundAPillarInThreeDimensions) {
  Physics physics = testing::dam_break();
  physics.dimension = 3;
  physics.gravity = {0, 0, -9.81};
  physics.tank = Extent{{0, 0, 0}, {1.6, 0.6, 0.75}};
  physics.obstacles->push_back({{0.9, 0.24, 0}, {1.02, 0.36, 0.75}});
  physics.blocks = {box({0, 0, 0}, {0.4, 0.6, 0.3}), box({0.4, 0, 0}, {0.9, 0.6, 0.01}),
                    box({0.9, 0, 0}, {1.02, 0.24, 0.01}), box({0.9, 0.36, 0}, {1.02, 0.6, 0.01}),
                    box({1.02, 0, 0}, {1.6, 0.6, 0.01})};
  physics.column = physics.blocks->front().box;
  EXPECT_EQ(physics.bed_depth(), Metres(0.01));
  physics.obstacles->clear();  // now there is a dry hole
  EXPECT_EQ(physics.bed_depth(), Metres(0.0));
}

TEST(BedDepth, IsNotKnownWithoutBlocksButCanBeStated) {
  Physics physics = testing::dam_break();
  physics.blocks.reset();
  EXPECT_FALSE(physics.bed_depth());
  physics.stated_bed = Metres(0.03);
  EXPECT_EQ(physics.bed_depth(), Metres(0.03));
}

}  // namespace
}  // namespace surge::compare
