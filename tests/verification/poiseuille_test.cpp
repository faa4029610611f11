#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "compare/verification/exact.hpp"
#include "tests/case/solver_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

/// RMS over the fluid of the error of the velocity at the end, over the steady speed in the middle.
template <class S>
double error_of(const std::string& method, const std::string& preset, const std::string& more) {
  const std::vector<std::string> choices{"method.name=" + method, "method.preset=" + preset,
                                         "time.end=1", more};
  const Computation c =
      read_computation(tests::sources() + "/particle/cases/poiseuille.toml", choices);
  S solver = test::make_solver<S>(c);
  while (solver.time() < c.flow.time.end)
    EXPECT_EQ(solver.step(c.flow.time.end - solver.time()).lost, 0);
  const auto& p = solver.particles();
  double sum = 0.0;
  double n = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] != ParticleType::fluid) continue;
    sum +=
        std::pow(p.v[0][i] - compare::channel_speed(0.8, 0.1, 1.0, p.x[1][i], solver.time()), 2) +
        std::pow(p.v[1][i], 2);
    n += 1.0;
  }
  EXPECT_EQ(n, 400.0);
  return std::sqrt(sum / n);
}

// The walls are where they should be and nu is nu: a wall half a spacing off would be an error of
// 10 %.
TEST(Poiseuille, Mps) {
  EXPECT_LT(error_of<mps::Solver<2>>("mps", "paper", "mps.viscous_term=laplacian"), 0.01);
  EXPECT_LT(error_of<mps::Solver<2>>("mps", "improved", "mps.viscous_term=deformation"), 0.01);
}

TEST(Poiseuille, Sph) {
  EXPECT_LT(error_of<sph::Solver<2>>("sph", "paper", "sph.viscous_term=laplacian"), 0.01);
  EXPECT_LT(error_of<sph::Solver<2>>("sph", "delta-plus", "sph.viscous_term=laplacian"), 0.01);
}

// On a square lattice the pairwise term feels shear along its axes by up to 11 % too little (see
// momentum.hpp), and in this flow the lattice lasts.
TEST(Poiseuille, SphByDeformation) {
  EXPECT_LT(error_of<sph::Solver<2>>("sph", "delta-plus", "sph.viscous_term=deformation"), 0.03);
}

// A slip wall does not hold the fluid: it falls freely, but for the bumps of a wall made of
// particles that slide past (a thousandth of the speed in MPS).
TEST(Poiseuille, SlipWallsDoNotRub) {
  for (const char* method : {"mps", "sph"}) {
    const std::vector<std::string> choices{std::string("method.name=") + method,
                                           "method.preset=paper", "time.end=0.2", "tank.wall=slip"};
    const Computation c =
        read_computation(tests::sources() + "/particle/cases/poiseuille.toml", choices);
    const auto largest_deviation = [&](auto solver) {
      while (solver.time() < c.flow.time.end) solver.step(c.flow.time.end - solver.time());
      double largest = 0.0;
      const auto& p = solver.particles();
      for (std::size_t i = 0; i < p.size(); ++i)
        if (p.type[i] == ParticleType::fluid)
          largest = std::max(largest, std::abs(p.v[0][i] - 0.8 * solver.time()));
      return largest;
    };
    EXPECT_LT(*method == 'm' ? largest_deviation(test::make_solver<mps::Solver<2>>(c))
                             : largest_deviation(test::make_solver<sph::Solver<2>>(c)),
              0.01 * 0.8 * 0.2)
        << method;
  }
}

}  // namespace
}  // namespace surge
