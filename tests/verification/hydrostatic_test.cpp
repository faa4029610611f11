#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/case/solver_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

struct LayerMean {
  double pressure = 0.0;  ///< Pa, mean over particles and time
  double depth = 0.0;     ///< m, of the same particles
  double v_max = 0.0;     ///< m/s, the largest seen
  long lost = 0;
};

/// Mean pressure of the fluid between two heights over the second half of the run.
template <class S>
LayerMean run_and_average(const Computation& c, double lower, double upper, double surface) {
  S solver = test::make_solver<S>(c);
  LayerMean mean;
  double weight = 0.0;
  while (solver.time() < c.flow.time.end) {
    const StepReport report = solver.step(c.flow.time.end - solver.time());
    mean.lost += report.lost;
    if (solver.time() < 0.5 * c.flow.time.end) continue;
    mean.v_max = std::max(mean.v_max, report.v_max);
    const auto& p = solver.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.type[i] != ParticleType::fluid || p.x[1][i] < lower || p.x[1][i] > upper) continue;
      mean.pressure += report.dt * p.pressure[i];
      mean.depth += report.dt * (surface - p.x[1][i]);
      weight += report.dt;
    }
  }
  mean.pressure /= weight;
  mean.depth /= weight;
  return mean;
}

class Hydrostatic : public testing::TestWithParam<std::string> {
 protected:
  LayerMean run(double lower, double upper) const {
    const std::vector<std::string> choices{"method.name=" + GetParam(), "method.preset=paper",
                                           "time.end=0.5"};
    const Computation c =
        read_computation(tests::sources() + "/particle/cases/hydrostatic_tank.toml", choices);
    return GetParam() == "mps" ? run_and_average<mps::Solver<2>>(c, lower, upper, 0.2)
                               : run_and_average<sph::Solver<2>>(c, lower, upper, 0.2);
  }
};

// Exact: p = rho g (H - y). The instantaneous pressure of MPS is noisy; what it must keep is the
// mean.
TEST_P(Hydrostatic, TankKeepsItsPressure) {
  for (const double lower : {0.0, 0.08}) {
    const LayerMean mean = run(lower, lower + 0.04);
    EXPECT_NEAR(mean.pressure, 1000.0 * 9.81 * mean.depth, 0.05 * 1000.0 * 9.81 * 0.2)
        << "above y = " << lower;
    EXPECT_EQ(mean.lost, 0);
    // Far below the speed of a collapse, sqrt(2 g H) = 2 m/s.
    EXPECT_LT(mean.v_max, 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Hydrostatic, testing::Values("mps", "sph"),
                         [](const auto& parameter) { return parameter.param; });

/// RMS over the fluid of p - rho g (H - y), over rho g H; root of the mean square over the last
/// quarter of the run. H = 0.2 m.
template <class S>
double pressure_error(const Computation& c) {
  S solver = test::make_solver<S>(c);
  const double scale = 1000.0 * 9.81 * 0.2;
  double sum = 0.0;
  double weight = 0.0;
  while (solver.time() < c.flow.time.end) {
    const StepReport report = solver.step(c.flow.time.end - solver.time());
    EXPECT_EQ(report.lost, 0);
    if (solver.time() < 0.75 * c.flow.time.end) continue;
    const auto& p = solver.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.type[i] != ParticleType::fluid) continue;
      const double error = p.pressure[i] / scale - (1.0 - p.x[1][i] / 0.2);
      sum += report.dt * error * error;
      weight += report.dt;
    }
  }
  return std::sqrt(sum / weight);
}

Computation still_water(const std::vector<std::string>& choices) {
  std::vector<std::string> all = choices;
  all.emplace_back("time.end=2");
  return read_computation(tests::sources() + "/particle/cases/hydrostatic_tank.toml", all);
}

// The recommended presets, 20 particles over the depth, between 1.5 and 2 s: not the mean but the
// pressure of every particle at every step.
TEST(SmoothPressure, DeltaPlus) {
  const double error =
      pressure_error<sph::Solver<2>>(still_water({"method.name=sph", "method.preset=delta-plus"}));
  EXPECT_LT(error, 0.01);
  // The diffusion of the whole density pushes it towards a constant, and more so the longer it
  // runs.
  EXPECT_GT(pressure_error<sph::Solver<2>>(still_water(
                {"method.name=sph", "method.preset=delta-plus", "sph.diffusion_of=density"})),
            1.2 * error);
}

// A shift as fast as single particles jitter would stir it up to 0.1 m/s in its third second.
TEST(StillWater, DeltaPlusDoesNotStirItself) {
  auto solver = test::make_solver<sph::Solver<2>>(
      still_water({"method.name=sph", "method.preset=delta-plus"}));
  double fastest = 0.0;
  while (solver.time() < 3.5) {
    const StepReport report = solver.step(3.5 - solver.time());
    if (solver.time() > 1.5) fastest = std::max(fastest, report.v_max);
  }
  EXPECT_LT(fastest, 0.02);
}

TEST(SmoothPressure, IsphShifted) {
  EXPECT_LT(
      pressure_error<isph::Solver<2>>(still_water({"method.name=isph", "method.preset=shifted"})),
      0.01);
}

TEST(SmoothPressure, MpsImproved) {
  EXPECT_LT(
      pressure_error<mps::Solver<2>>(still_water({"method.name=mps", "method.preset=improved"})),
      0.005);
}

}  // namespace
}  // namespace surge
