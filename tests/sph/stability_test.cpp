#include "particle/sph/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "particle/sph/solver.hpp"

namespace surge::sph {
namespace {

/// Fluid at rest in a periodic box of `columns` particles along each axis, c0 = 10 m/s; every
/// particle has a random velocity of up to 1e-6 m/s, in which all waves are.
struct Box : Case {
  Params method;
};

template <int D>
Box still_box(int columns, double damping) {
  const double l0 = 1.0 / columns;
  Box c;
  c.dimension = D;
  c.gravity = {0.0, 0.0, 0.0};
  c.reference_speed = 1.0;
  c.has_tank = true;
  c.tank.box = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  c.tank.periodic = {true, true, D == 3};
  c.spacing = l0;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1e-6, 1e-6);
  std::array<int, 3> k{};
  for (k[2] = 0; k[2] < (D == 3 ? columns : 1); ++k[2])
    for (k[1] = 0; k[1] < columns; ++k[1])
      for (k[0] = 0; k[0] < columns; ++k[0]) {
        FluidBlock block;
        for (std::size_t a = 0; a < D; ++a) {
          block.box.lower[a] = k[a] * l0;
          block.box.upper[a] = (k[a] + 1) * l0;
          block.velocity[a] = any(random);
        }
        c.blocks.push_back(block);
      }
  c.time.courant = 1e3;
  c.time.initial_step = c.time.maximum_step = 1.0;
  Params p;
  p.kernel = Kernel::wendland_c2;
  p.h_over_l0 = 1.5;
  p.xsph_epsilon = 0.0;
  p.density_diffusion = 0.1;
  p.acoustic_damping = damping;
  c.method = p;
  return c;
}

/// By how much the largest velocity has grown after `steps` steps of N h/c0.
template <int D>
double growth(Box c, double courant, int steps) {
  c.method.acoustic_courant = courant;
  Solver<D> solver(c, c.method, Search::cell_grid);
  for (int k = 0; k < steps; ++k)
    if (solver.step(1.0).v_max > 1e-2) return std::numeric_limits<double>::infinity();
  return solver.step(1.0).v_max / 1e-6;
}

template <int D>
double limit_of(const Box& c, double share) {
  return LatticeWaves(Model<D>(c, c.method))
      .courant_limit(c.method.density_diffusion, c.method.acoustic_damping, share);
}

TEST(LatticeWaves, PlainLeapFrogIsStableForTwoOverTheFrequency) {
  const Box c = still_box<2>(12, 0.0);
  const LatticeWaves waves{Model<2>(c, c.method)};
  // The largest gradient of this kernel on this lattice is 1.126/h.
  EXPECT_NEAR(waves.courant_limit(0.0, 0.0, 1.0), 2.0 / 1.126, 0.01);
  EXPECT_LT(waves.courant_limit(0.1, 0.0, 1.0), waves.courant_limit(0.0, 0.0, 1.0));
  EXPECT_EQ(waves.damper_share(0.1, 2.0, 0.1), 1.0) << "a short step sees all";
}

// From both sides: the share that damper_share() gives for a step makes that step the limit.
TEST(LatticeWaves, ShareOfTheDamperAndLimitOfTheStepAreEachOthersInverse) {
  const Box c = still_box<2>(12, 2.0);
  const LatticeWaves waves{Model<2>(c, c.method)};
  for (const double courant : {0.8, 1.0, 1.2, 1.4}) {
    const double share = waves.damper_share(0.1, 2.0, courant);
    EXPECT_LT(share, 1.0);
    EXPECT_NEAR(waves.courant_limit(0.1, 2.0, share), courant, 1e-9);
  }
  EXPECT_EQ(waves.damper_share(0.1, 2.0, 2.0), 0.0) << "unstable whatever is damped";
}

// Just under the limit nothing grows, above it waves do: sound and diffusion, 2D and 3D.
TEST(LatticeWaves, SoundIsStableUnderTheLimitAndNotAbove) {
  const Box plane = still_box<2>(12, 0.0);
  EXPECT_LT(growth<2>(plane, 0.96 * limit_of<2>(plane, 1.0), 300), 2.0);
  EXPECT_GT(growth<2>(plane, 1.10 * limit_of<2>(plane, 1.0), 300), 1e3);
  const Box solid = still_box<3>(6, 0.0);
  EXPECT_LT(growth<3>(solid, 0.96 * limit_of<3>(solid, 1.0), 100), 2.0);
  EXPECT_GT(growth<3>(solid, 1.15 * limit_of<3>(solid, 1.0), 100), 1e3);
}

// However much is damped, the damper itself never makes a step unstable.
TEST(LatticeWaves, DampingDoesNotBindTheStep) {
  for (const double damping : {2.0, 10.0}) {
    // Shear is not damped: the largest velocity of the start, of 1.4e-6 m/s, may stay.
    EXPECT_LT(growth<2>(still_box<2>(12, damping), 0.9, 300), 1.42) << damping;
    // An explicit damper is stable up to this only.
    EXPECT_LT(limit_of<2>(still_box<2>(12, damping), 1.0), 0.7) << damping;
  }
}

}  // namespace
}  // namespace surge::sph
