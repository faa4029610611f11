#include <gtest/gtest.h>

#include <cmath>

#include "particle/kernel/quintic_spline.hpp"
#include "particle/sph/continuity.hpp"
#include "particle/sph/momentum.hpp"
#include "particle/sph/xsph.hpp"

namespace surge::sph {
namespace {

constexpr double l0 = 0.01;
constexpr double h = 1.2 * l0;
constexpr double rho = 1000.0;
constexpr double mass = rho * l0 * l0;

/// Calls f(dx, r, slope) for the lattice points around the origin, dx = x_j - x_i.
template <class F>
void over_lattice(F&& f) {
  const QuinticSpline<2> kernel(h);
  for (int k = -4; k <= 4; ++k)
    for (int m = -4; m <= 4; ++m) {
      if (k == 0 && m == 0) continue;
      const std::array<double, 2> dx{k * l0, m * l0};
      const double r = std::hypot(dx[0], dx[1]);
      f(dx, r, kernel.derivative(r) / r);
    }
}

// Eq. (20) on a linear velocity field: D rho/Dt = -rho div v.
TEST(Continuity, DivergenceOfALinearField) {
  const double a = 3.0;
  const double b = -1.2;
  double rate = 0.0;
  over_lattice([&](const auto& dx, double, double slope) {
    const std::array<double, 2> dv{a * dx[0] + 5.0 * dx[1], b * dx[1] - 4.0 * dx[0]};
    rate += mass * continuity<double, 2>(dv, dx, slope);
  });
  EXPECT_NEAR(rate, -rho * (a + b), 2e-3 * rho * a);
}

TEST(Continuity, RigidMotionChangesNothing) {
  double rate = 0.0;
  over_lattice([&](const auto& dx, double, double slope) {
    const std::array<double, 2> rotation{-7.0 * dx[1], 7.0 * dx[0]};
    rate += mass * continuity<double, 2>(rotation, dx, slope);
  });
  EXPECT_NEAR(rate, 0.0, 1e-9);
}

// 2 (rho_j - rho_i) x . grad W / r^2 m/rho is twice the Laplacian's Brookshaw form: lap rho exactly
// for a quadratic field up to the lattice error.
TEST(DensityDiffusion, IsTheLaplacian) {
  double sum = 0.0;
  over_lattice([&](const auto&, double r, double slope) {
    sum += density_diffusion(r * r, mass / rho, slope);
  });
  EXPECT_NEAR(sum, 4.0, 0.02);
}

// Water at rest has rho(p) with p = rho g depth: what the correction takes off is what is there, so
// the diffusion of the dynamic density vanishes pair by pair, and with one-sided neighbours too.
TEST(DensityDiffusion, OfTheDynamicDensityVanishesInStillWater) {
  const double c0 = 20.0;
  const double g = 9.81;
  for (const double gamma : {7.0, 1.0}) {
    // d rho/dz = rho g / c^2 integrates to rho^(gamma-1) = rho0^(gamma-1) (1 + (gamma-1) g z /
    // c0^2)
    const auto still = [&](double z) {
      if (gamma == 1.0) return rho * std::exp(g * z / (c0 * c0));
      return rho * std::pow(1.0 + (gamma - 1.0) * g * z / (c0 * c0), 1.0 / (gamma - 1.0));
    };
    for (const double depth : {0.05, 0.2, 0.4}) {
      double plain = 0.0;
      double dynamic = 0.0;
      over_lattice([&](const auto& dx, double, double slope) {
        if (dx[1] < 0.0) return;  // neighbours on one side only, as at a surface
        const double rho_i = still(depth);
        const double rho_j = still(depth + dx[1]);
        const double difference = rho_j - rho_i;
        const double part =
            hydrostatic_difference(g * dx[1], 0.5 * (rho_i + rho_j), rho, c0, gamma);
        plain += density_diffusion(difference, mass / rho, slope);
        dynamic += density_diffusion(difference - part, mass / rho, slope);
      });
      EXPECT_GT(plain, 1.0);
      // (1 + x)^(gamma-1) is taken to first order: 15 x^2 with x = rho/rho0 - 1 = 1 % at 0.4 m.
      EXPECT_LT(std::abs(dynamic), 3e-3 * plain) << "gamma " << gamma << ", depth " << depth;
    }
  }
}

TEST(DensityDiffusion, HydrostaticPartOfAPairIsAntisymmetric) {
  EXPECT_EQ(hydrostatic_difference(0.3, 1004.0, rho, 20.0, 7.0),
            -hydrostatic_difference(-0.3, 1004.0, rho, 20.0, 7.0));
  EXPECT_EQ(hydrostatic_difference(0.0, 1004.0, rho, 20.0, 7.0), 0.0);
}

// Eq. (22) on a linear pressure field: -(1/rho) grad p.
TEST(PressureTerm, GradientOfALinearField) {
  const double slope_x = 9810.0;
  std::array<double, 2> acceleration{};
  over_lattice([&](const auto& dx, double, double slope) {
    const double factor =
        pressure_term(500.0 / (rho * rho), (500.0 + slope_x * dx[0]) / (rho * rho), slope);
    for (std::size_t a = 0; a < 2; ++a) acceleration[a] += mass * factor * dx[a];
  });
  EXPECT_NEAR(acceleration[0], -slope_x / rho, 2e-3 * slope_x / rho);
  EXPECT_NEAR(acceleration[1], 0.0, 1e-10);
}

TEST(ArtificialViscosity, ActsOnApproachingPairsOnly) {
  EXPECT_EQ(artificial_viscosity(0.3, 1e-4, rho, 0.1, h * h), 0.0);
  EXPECT_GT(artificial_viscosity(-0.3, 1e-4, rho, 0.1, h * h), 0.0);
}

TEST(ArtificialViscosity, AddsOnlyWhatTheFluidLacks) {
  EXPECT_EQ(artificial_share<2>(0.08, 0.0), 0.08);
  EXPECT_NEAR(artificial_share<2>(0.08, 0.004), 0.048, 1e-15);
  EXPECT_EQ(artificial_share<2>(0.08, 0.02), 0.0);
  EXPECT_NEAR(artificial_share<3>(0.08, 0.004), 0.04, 1e-15);
}

// Morris et al.: nu lap v on a parabolic profile.
TEST(LaminarViscosity, LaplacianOfAParabolicProfile) {
  const double nu = 1e-2;
  double acceleration = 0.0;
  over_lattice([&](const auto& dx, double r, double slope) {
    acceleration += laminar_viscosity(r * r, slope, mass / rho, nu, h * h) * (dx[1] * dx[1]);
  });
  // The regularisation 0.01 h^2 in the denominator costs about half a percent.
  EXPECT_NEAR(acceleration, 2.0 * nu, 0.02 * 2.0 * nu);
}

/// The term's sum at the middle of a wide lattice, h = 4 l0, on which it is nearly isotropic.
template <class V>
std::array<double, 2> deformation(double nu, V&& velocity) {
  const double wide = 4.0 * l0;
  const QuinticSpline<2> kernel(wide);
  std::array<double, 2> sum{};
  for (int k = -12; k <= 12; ++k)
    for (int m = -12; m <= 12; ++m) {
      if (k == 0 && m == 0) continue;
      const std::array<double, 2> dx{k * l0, m * l0};
      const double r = std::hypot(dx[0], dx[1]);
      const std::array<double, 2> dv = velocity(dx[0], dx[1]);
      const double factor = deformation_viscosity<2>(dv[0] * dx[0] + dv[1] * dx[1], r * r,
                                                     kernel.derivative(r) / r, mass / rho, nu);
      for (std::size_t a = 0; a < 2; ++a) sum[a] += factor * dx[a];
    }
  return sum;
}

// nu (lap v + 2 grad div v).
TEST(DeformationViscosity, OfShearSqueezeAndRotation) {
  using V = std::array<double, 2>;
  const double nu = 1e-2;
  const V shear = deformation(nu, [](double, double y) { return V{y * y, 0.0}; });
  EXPECT_NEAR(shear[0], 2.0 * nu, 0.02 * 2.0 * nu);
  EXPECT_NEAR(shear[1], 0.0, 1e-12);
  const V squeeze = deformation(nu, [](double x, double) { return V{x * x, 0.0}; });
  EXPECT_NEAR(squeeze[0], 6.0 * nu, 0.02 * 6.0 * nu);
  const V turn = deformation(nu, [](double x, double y) { return V{-y, x}; });
  EXPECT_NEAR(turn[0], 0.0, 1e-12);
  EXPECT_NEAR(turn[1], 0.0, 1e-12);
}

TEST(Xsph, WeightsSumToOneOverTheLattice) {
  const QuinticSpline<2> kernel(h);
  double sum = xsph_weight(mass / rho, kernel.value(0.0));
  over_lattice(
      [&](const auto&, double r, double) { sum += xsph_weight(mass / rho, kernel.value(r)); });
  EXPECT_NEAR(sum, 1.0, 1e-3);
}

}  // namespace
}  // namespace surge::sph
