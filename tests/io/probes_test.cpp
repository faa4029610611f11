#include "particle/io/probes.hpp"

#include <gtest/gtest.h>

#include "tests/io/case_fixture.hpp"

namespace surge {
namespace {

constexpr double l0 = 0.01;

/// Water on the left of a wall at x = 0.12, down to y = 0, on the lattice, with a pressure p(x, y).
template <class F>
Particles<2> lattice(F p, double shift) {
  Particles<2> particles;
  particles.resize(20 * 40);
  for (std::size_t k = 0; k < particles.size(); ++k) {
    particles.x[0][k] = 0.12 - l0 * (0.5 + static_cast<double>(k % 20));
    particles.x[1][k] = l0 * (0.5 + static_cast<double>(k / 20)) - shift;
    particles.type[k] = ParticleType::fluid;
    particles.pressure[k] = p(particles.x[0][k], particles.x[1][k]);
  }
  return particles;
}

double measured(const Particles<2>& particles) {
  const Case c = test::make_case({"probe.0.position=[0.12,0.1]"});
  return Probes<2>(c).measure(particles)[0];
}

TEST(Probes, KeepAConstantPressureAtAWall) {
  EXPECT_NEAR(measured(lattice([](double, double) { return 7.0; }, 0.003)), 7.0, 1e-12);
}

TEST(Probes, HydrostaticPressureAtAWallIsWithinATenthOfASpacing) {
  // Wherever the lattice lies beside the probe at y = 0.1.
  for (double shift = 0.0; shift < l0; shift += 0.1 * l0) {
    const double found = measured(lattice([](double, double y) { return -y; }, shift));
    EXPECT_NEAR(found, -0.1, 0.1 * l0) << shift;
  }
}

TEST(Probes, MeasureHalfASpacingInFrontOfAWall) {
  for (double shift = 0.0; shift < l0; shift += 0.1 * l0) {
    const double away = measured(lattice([](double x, double) { return 0.12 - x; }, shift));
    EXPECT_GT(away, 0.5 * l0) << shift;
    EXPECT_LT(away, 0.65 * l0) << shift;
  }
}

TEST(Probes, FeelNothingWhereThereIsNoWater) {
  EXPECT_EQ(measured(Particles<2>()), 0.0);
}

}  // namespace
}  // namespace surge
