#include "particle/core/initial_particles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace surge {
namespace {

/// A layer of water 1 m long and 0.5 m deep between walls.
Case layer(double spacing) {
  Case c;
  c.has_tank = true;
  c.tank.box = {{0.2, 0.1, 0.0}, {1.2, 1.1, 0.0}};
  FluidBlock block;
  block.box = {{0.2, 0.1, 0.0}, {1.2, 0.6, 0.0}};
  c.blocks = {block};
  c.spacing = spacing;
  return c;
}

TEST(InitialWave, MovesTheSurfaceAsLinearTheorySays) {
  Case c = layer(0.01);
  c.blocks[0].wave_amplitude = 0.02;
  const Particles<2> p = initial_particles<2>(c, 1);
  const double k = std::numbers::pi;
  const double omega = std::sqrt(9.81 * k * std::tanh(0.5 * k));
  double lift = 0.0;
  double kinetic = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] != ParticleType::fluid) continue;
    const double phase = k * (p.x[0][i] - 0.2);
    // d/dt of the surface's amplitude (2/L) int int cos kx dA, which moves with the particles
    lift -= 2.0 * 1e-4 * k * std::sin(phase) * p.v[0][i];
    kinetic += 0.5 * 1e-4 * (p.v[0][i] * p.v[0][i] + p.v[1][i] * p.v[1][i]);
  }
  EXPECT_NEAR(lift, omega * 0.02, 1e-3 * omega * 0.02);
  // All energy is kinetic when the surface is flat: g A^2 L/4 per mass of unit density.
  EXPECT_NEAR(kinetic, 9.81 * 0.02 * 0.02 / 4.0, 1e-3 * 9.81 * 0.02 * 0.02 / 4.0);
}

TEST(InitialWave, HasNeitherDivergenceNorNormalVelocityAtWalls) {
  Case c = layer(0.005);
  c.blocks[0].wave_amplitude = 0.02;
  const Particles<2> p = initial_particles<2>(c, 1);
  const auto at = [&](std::size_t column, std::size_t row) { return row * 200 + column; };
  const double l0 = c.spacing;
  ASSERT_NEAR(p.x[0][at(1, 0)] - p.x[0][at(0, 0)], l0, 1e-12) << "x runs fastest";
  const double scale = 0.02 * std::numbers::pi * 5.3;
  for (const std::size_t column : {10, 60, 150}) {
    for (const std::size_t row : {5, 50, 90}) {
      const double divergence = (p.v[0][at(column + 1, row)] - p.v[0][at(column - 1, row)] +
                                 p.v[1][at(column, row + 1)] - p.v[1][at(column, row - 1)]) /
                                (2.0 * l0);
      EXPECT_NEAR(divergence, 0.0, 1e-3 * scale);
    }
    EXPECT_NEAR(p.v[1][at(column, 0)], 0.0, l0 * scale);
  }
  EXPECT_NEAR(p.v[0][at(0, 99)], 0.0, l0 * scale * std::numbers::pi);
}

TEST(StillGravity, DropsWhatDrivesAPeriodicFlow) {
  Case c = layer(0.05);
  c.gravity = {0.8, -2.0, 0.0};
  EXPECT_EQ(still_gravity(c), (Point{0.8, -2.0, 0.0}));
  c.tank.periodic[0] = true;
  EXPECT_EQ(still_gravity(c), (Point{0.0, -2.0, 0.0}));
  EXPECT_NEAR(initial_depth<2>(c, {0.3, 0.35}, 0.1), 0.25, 1e-12);
  EXPECT_NEAR(reference_speed(c), std::sqrt(2.0 * 2.0 * 0.5), 1e-12);
  c.reference_speed = 7.0;
  EXPECT_EQ(reference_speed(c), 7.0);
}

}  // namespace
}  // namespace surge
