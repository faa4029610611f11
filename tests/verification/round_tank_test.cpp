#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/case/solver_fixture.hpp"

namespace surge {
namespace {

constexpr double radius = 0.5;  // m

/// A horizontal cylinder, in 2D a polygon of 48 corners, half full of water that moves to the
/// right.
std::string round_tank() {
  std::ostringstream text;
  text << "title = \"Sloshing in a round tank\"\ndimension = 2\n[fluid]\ndensity = 1000.0\n"
          "gravity = [0.0, -9.81]\n[tank]\nlower = [-0.56, -0.56]\nupper = [0.56, 0.56]\n"
          "polygon = [";
  for (int k = 0; k < 48; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.5) / 48;
    text << (k > 0 ? ", [" : "[") << radius * std::cos(angle) << ", " << radius * std::sin(angle)
         << ']';
  }
  text << "]\n[[block]]\nshape = \"box\"\nlower = [-0.56, -0.56]\nupper = [0.56, 0.0]\n"
          "velocity = [0.1, 0.0]\n[resolution]\nspacing = 0.04\n[time]\nend = 1.5\n"
          "[output]\ninterval = 1.0\n";
  return text.str();
}

/// When the water's centre of mass passes the middle for the second time: after a period.
template <class S>
double period_of(const std::string& method, const std::string& preset) {
  const Computation c = parse_computation(
      round_tank() + "[method]\nname = \"" + method + "\"\npreset = \"" + preset + "\"\n",
      "round_tank.toml", {});
  S solver = test::make_solver<S>(c);
  double before = 0.0, time = 0.0;
  int passed = 0;
  while (solver.time() < c.flow.time.end) {
    EXPECT_EQ(solver.step(c.flow.time.end - solver.time()).lost, 0);
    const Particles<2>& p = solver.particles();
    double middle = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.type[i] == ParticleType::fluid) middle += p.x[0][i];
    if (before * middle < 0.0 && solver.time() > 0.1 && ++passed == 2)
      return time + (solver.time() - time) * before / (before - middle);
    before = middle;
    time = solver.time();
  }
  ADD_FAILURE() << "no period in " << c.flow.time.end << " s";
  return 0.0;
}

// The first mode of a half full circle: omega^2 R/g = 1.3557 (the problem of McIver 1989, J. Fluid
// Mech. 201, solved by finite elements). Twelve particles to the radius; the other modes that the
// start has, and walls that the particles feel to half a spacing, make up the rest.
void expect_first_mode(double period) {
  const double exact = 2.0 * std::numbers::pi / std::sqrt(1.3557 * 9.81 / radius);
  EXPECT_NEAR(period / exact, 1.0, 0.04);
}

TEST(RoundTank, PeriodOfTheFirstModeMps) {
  expect_first_mode(period_of<mps::Solver<2>>("mps", "improved"));
}
TEST(RoundTank, PeriodOfTheFirstModeSph) {
  expect_first_mode(period_of<sph::Solver<2>>("sph", "delta-plus"));
}
TEST(RoundTank, PeriodOfTheFirstModeIsph) {
  expect_first_mode(period_of<isph::Solver<2>>("isph", "shifted"));
}

}  // namespace
}  // namespace surge
