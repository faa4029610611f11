#include "particle/core/particle_count.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "particle/core/initial_particles.hpp"

namespace surge {
namespace {

/// A tank of 6 x 8 x 4 spacings with a block, a ball and a hollow and a full obstacle.
Case full_case(int dimension) {
  Case c;
  c.dimension = dimension;
  c.spacing = 0.1;
  c.has_tank = true;
  const double depth = dimension == 3 ? 0.4 : 0.0;
  c.tank.box = {{0.0, 0.0, 0.0}, {0.6, 0.8, depth}};
  FluidBlock block;
  block.box = {{0.0, 0.0, 0.0}, {0.2, 0.5, depth}};
  FluidBlock ball;
  ball.shape = FluidBlock::Shape::ball;
  ball.box = {{0.2, 0.3, 0.0}, {0.6, 0.7, depth}};
  c.blocks = {block, ball};
  c.obstacles = {{{0.2, 0.0, 0.0}, {0.3, 0.1, depth}}, {{3.0, 3.0, 0.0}, {4.0, 3.7, 10 * depth}}};
  return c;
}

template <int D>
void expect_exact(const Case& c, int layers) {
  const Particles<D> made = initial_particles<D>(c, layers);
  const auto fluid =
      static_cast<double>(std::count(made.type.begin(), made.type.end(), ParticleType::fluid));
  const ParticleCount count = count_particles(c, layers);
  EXPECT_EQ(count.fluid, fluid) << layers;
  EXPECT_EQ(count.wall, static_cast<double>(made.size()) - fluid) << layers;
}

TEST(ParticleCount, IsWhatIsMadeWithAnySidesAndLayers) {
  for (const int layers : {1, 3, 5}) {
    for (const bool open : {false, true}) {
      for (const bool periodic : {false, true}) {
        Case plane = full_case(2), space = full_case(3);
        for (Case* c : {&plane, &space}) {
          c->tank.open[3] = open;
          c->tank.periodic[0] = periodic;
        }
        space.tank.open[4] = open;
        expect_exact<2>(plane, layers);
        expect_exact<3>(space, layers);
      }
    }
  }
}

TEST(ParticleCount, BallsOfAnySizeAreCountedAsTheyAreFilled) {
  for (int across = 1; across <= 24; ++across) {
    Case c;
    c.spacing = 0.05;
    FluidBlock ball;
    ball.shape = FluidBlock::Shape::ball;
    const double side = across * c.spacing;
    ball.box = {{0.3, -0.2, 0.1}, {0.3 + side, -0.2 + side, 0.1 + side}};
    c.blocks = {ball};
    expect_exact<2>(c, 0);
    c.dimension = 3;
    expect_exact<3>(c, 0);
  }
}

TEST(ParticleCount, CountsWhatNoMemoryHolds) {
  Case c = full_case(3);
  c.spacing = 1e-6;
  const ParticleCount count = count_particles(c, 3);
  EXPECT_NEAR(count.fluid / (0.04e18 + 0.064e18 * 0.5235987755982988), 1.0, 1e-9);
  EXPECT_GT(count.wall, 1e12);
}

}  // namespace
}  // namespace surge
