#include "particle/mps/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "particle/mps/free_surface.hpp"
#include "particle/mps/shifting.hpp"
#include "particle/mps/solver.hpp"
#include "tests/mps/lattice.hpp"

namespace surge::mps {
namespace {

using testing::l0;

/// Choices as in the preset `improved`, as far as they bound the step.
Params choices() {
  Params p;
  p.courant_factor = 2.0;
  p.re_gradient = p.re_laplacian = 3.1;
  p.source = Source::divergence_and_density;
  p.density_share = 0.0;
  p.laplacian_of = LaplacianOf::dynamic_pressure;
  p.lambda = Lambda::lattice;
  p.gradient = GradientModel::corrected;
  p.wall_coupling = WallCoupling::fluid;
  p.negative_pressure = NegativePressure::keep;
  p.surface_offset = 0.3;
  p.surface_at = SurfaceAt::half_spacing;
  p.position_update = PositionUpdate::mean_velocity;
  p.collision_distance = 0.8;
  p.shifting = 1.0;
  return p;
}

Case still_case(int dimension) {
  Case c;
  c.dimension = dimension;
  c.gravity = {0.0, 0.0, 0.0};
  c.spacing = l0;
  c.time.initial_step = c.time.maximum_step = 1.0;
  return c;
}

TEST(StepLimits, WithoutAFactorEquation25Stands) {
  Case c = still_case(2);
  c.time.courant = 0.7;
  Params p = choices();
  p.courant_factor = 0.0;
  EXPECT_EQ(StepLimits(c, p)(3.0, 9.81), 0.7 * l0 / 3.0);
  EXPECT_EQ(StepLimits(c, p)(0.0, 9.81), 1.0);
}

TEST(StepLimits, TheFactorLengthensTheStepAsFarAsCollisionsAndShiftingAllow) {
  Case c = still_case(2);
  Params p = choices();
  c.time.courant = 0.15;
  EXPECT_DOUBLE_EQ(StepLimits(c, p)(3.0, 0.0), 0.3 * l0 / 3.0);
  c.time.courant = 1.0;
  EXPECT_DOUBLE_EQ(StepLimits(c, p).courant(), 0.4) << "half the distance of collisions";
  p.collision_distance = 0.0;
  EXPECT_NEAR(StepLimits(c, p).courant(), 0.737 / disorder, 1e-3);
  p.shifting = 2.0;
  EXPECT_NEAR(StepLimits(c, p).courant(), 0.737 / disorder / 2.0, 1e-3);
  p.shifting = 0.0;
  EXPECT_DOUBLE_EQ(StepLimits(c, p).courant(), 2.0);
}

TEST(StepLimits, FreeFallStaysAwayFromCollisionsAndWalls) {
  const Case c = still_case(3);
  Params p = choices();
  EXPECT_DOUBLE_EQ(StepLimits(c, p)(0.0, 9.81), std::sqrt(0.2 * l0 / 9.81));
  p.collision_distance = 0.3;
  EXPECT_DOUBLE_EQ(StepLimits(c, p)(0.0, 9.81), std::sqrt(0.5 * l0 / 9.81));
  p.wall_distance = 0.2;
  EXPECT_DOUBLE_EQ(StepLimits(c, p)(0.0, 9.81), std::sqrt(0.3 * l0 / 9.81));
  p.collision_distance = 1.0;
  p.wall_distance = 0.5;  // there is no way to fall: surface waves are left
  EXPECT_NEAR(StepLimits(c, p)(0.0, 9.81), std::sqrt(0.6366 * l0 / 9.81), 1e-6);
}

/// Largest displacement of a lattice of alternating columns after `steps` shifts, over the first.
template <int D>
double shifting_growth(double courant, int steps) {
  constexpr double re = 3.1;
  const double first = 1e-7 * l0;
  double size = first;
  for (int k = 0; k < steps && std::abs(size) < 1e-3 * l0; ++k) {
    testing::Lattice<D> lattice(4, re * l0);
    const auto sign_of = [&](std::size_t i) {
      return std::lround(lattice.x[0][i] / l0) % 2 == 0 ? 1.0 : -1.0;
    };
    for (std::size_t i = 0; i < lattice.x[0].size(); ++i) lattice.x[0][i] += size * sign_of(i);
    const Vec<D> gradient = concentration_gradient<D>(
        lattice.middle, lattice.list.of(lattice.middle), Displacement<D>(lattice.x, {}), re * l0,
        reference_number_density<D>(re));
    size += shift<D>(gradient, {}, 1.0, l0, courant * l0)[0];
  }
  return std::abs(size) / first;
}

// The displacement goes back for a small Courant number, beyond its place for a larger one, and
// grows above the limit. In 3D a longer wave than this one is the first to grow.
TEST(StepLimits, ShiftingIsStableUnderItsLimitAndNotAbove) {
  const double limit = StepLimits::shifting_limit(2, 3.1);
  EXPECT_NEAR(limit, 2.0 / 2.712, 1e-3);
  EXPECT_LT(shifting_growth<2>(0.96 * limit, 60), 0.05);
  EXPECT_GT(shifting_growth<2>(1.04 * limit, 60), 20.0);
  EXPECT_LT(StepLimits::shifting_limit(2, 2.1), limit);
  EXPECT_NEAR(StepLimits::shifting_limit(3, 3.1), 2.0 / 1.824, 1e-3);
  EXPECT_LT(shifting_growth<3>(0.96 * StepLimits::shifting_limit(3, 3.1), 40), 0.2);
}

/// Of particles that fly at each other from all phases of a step: how many fly through each other.
int passed(double courant) {
  Params p = choices();
  p.courant_factor = 0.0;  // Eq. (25): the step that we ask for
  int count = 0;
  for (int phase = 0; phase < 20; ++phase) {
    Case c = still_case(2);
    c.time.courant = courant;
    const double gap = (3.0 + 2.0 * courant * phase / 20.0) * l0;
    for (const double side : {-1.0, 1.0}) {
      FluidBlock block;
      const double x = 0.5 * side * gap;
      block.box = {{x - 0.5 * l0, -0.5 * l0, 0.0}, {x + 0.5 * l0, 0.5 * l0, 0.0}};
      block.velocity = {-side, 0.0, 0.0};
      c.blocks.push_back(block);
    }
    Solver<2> solver(c, p, Search::cell_grid);
    const auto apart = [&] {
      const Particles<2>& now = solver.particles();
      return now.x[0][now.id[0] == 0 ? 1 : 0] - now.x[0][now.id[0] == 0 ? 0 : 1];
    };
    EXPECT_NEAR(apart(), gap, 1e-12);
    for (double time = 0.0; time < 3.0 * l0; time = solver.time()) solver.step(1.0);
    count += apart() < 0.0 ? 1 : 0;
  }
  return count;
}

// At the limit every pair is seen before it is past: the step is what holds them apart.
TEST(StepLimits, NoPairPassesEachOtherUnderTheLimitOfCollisions) {
  EXPECT_EQ(passed(0.99 * 0.4), 0);
  EXPECT_GT(passed(1.15 * 0.4), 0);
}

/// The fastest speed over that of free fall in a step, in the first `steps` steps of still water.
double stirred(double factor, int steps) {
  Case c = still_case(2);
  c.gravity = {0.0, -9.81, 0.0};
  c.has_tank = true;
  c.tank.box = {{0.0, 0.0, 0.0}, {8 * l0, 16 * l0, 0.0}};
  c.tank.periodic = {true, false, false};
  c.tank.open[3] = true;
  FluidBlock block;
  block.box = {{0.0, 0.0, 0.0}, {8 * l0, 8 * l0, 0.0}};
  c.blocks.push_back(block);
  Params p = choices();
  const double limit = StepLimits(c, p)(0.0, 9.81);
  p.courant_factor = 0.0;
  c.time.courant = 1e3;
  const double dt = factor * limit;
  c.time.maximum_step = c.time.initial_step = dt;
  Solver<2> solver(c, p, Search::cell_grid);
  double fastest = 0.0;
  for (int k = 0; k < steps; ++k) fastest = std::max(fastest, solver.step(dt).v_max);
  return fastest / (9.81 * dt);
}

TEST(StepLimits, StillWaterStaysStillUnderTheLimitOfFreeFallAndNotAbove) {
  EXPECT_LT(stirred(0.98, 50), 1e-3);
  EXPECT_GT(stirred(1.02, 5), 0.1);
}

}  // namespace
}  // namespace surge::mps
