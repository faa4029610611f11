#include <gtest/gtest.h>

#include "particle/sph/equation_of_state.hpp"

namespace surge::sph {
namespace {

TEST(EquationOfState, ZeroAtTheReferenceDensityWithTheSpeedOfSoundAsSlope) {
  const double rho0 = 1000.0;
  const double c0 = 24.0;
  for (const double gamma : {7.0, 1.0, 1.4}) {
    const EquationOfState state(rho0, c0, gamma);
    EXPECT_EQ(state.pressure(rho0), 0.0);
    const double step = 1e-4;
    const double slope = (state.pressure(rho0 + step) - state.pressure(rho0 - step)) / (2.0 * step);
    EXPECT_NEAR(slope, c0 * c0, 1e-5 * c0 * c0) << "dp/drho = c0^2, gamma = " << gamma;
  }
}

TEST(EquationOfState, DensityInvertsPressure) {
  const EquationOfState state(1000.0, 24.0, 7.0);
  for (const double rho : {970.0, 1000.0, 1000.01, 1003.0, 1050.0})
    EXPECT_NEAR(state.density(state.pressure(rho)), rho, 1e-9);
}

// Eq. (26): the corrected density gives the hydrostatic pressure back.
TEST(EquationOfState, HydrostaticDensityGivesHydrostaticPressure) {
  const double g = 9.81;
  const EquationOfState state(1000.0, 24.0, 7.0);
  for (const double depth : {0.0, 0.0025, 0.1, 0.29})
    EXPECT_NEAR(state.pressure(hydrostatic_density(state, 1000.0, g, depth)), 1000.0 * g * depth,
                1e-6);
}

}  // namespace
}  // namespace surge::sph
