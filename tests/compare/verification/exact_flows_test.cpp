#include "compare/verification/exact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr double pi = std::numbers::pi;

/// int_a^b f by Simpson's rule.
template <class F>
double integral(double a, double b, F&& f) {
  constexpr int n = 2000;
  double sum = f(a) + f(b);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(a + (b - a) * i / n);
  return sum * (b - a) / (3.0 * n);
}

// a b = 1 and sigma^2 (a^2 + b^2) = 2 A^2 leave one quadrature: A t = int_1^b sqrt((b^2 + b^-2)/2)
// db/b, which knows nothing of the scheme that integrates the equations of motion.
TEST(ExactDrop, AgreesWithTheQuadratureOfItsEnergy) {
  for (const double t : {0.1, 0.4, 0.8, 2.0}) {
    const DropAxes axes = drop_axes(100.0, 0.01 * t);
    EXPECT_NEAR(axes.x * axes.y, 1.0, 1e-10);
    const double time = integral(
        1.0, axes.y, [](double b) { return std::sqrt(0.5 * (b * b + 1.0 / (b * b))) / b; });
    EXPECT_NEAR(time, t, 1e-9);
  }
  EXPECT_EQ(drop_axes(100.0, 0.0).x, 1.0);
}

// Volume and kinetic energy stay, and so does the form of a sphere that does not move.
TEST(ExactEllipsoid, KeepsItsVolumeAndEnergy) {
  const std::array<double, 3> rates{100.0, -70.0, -30.0};
  constexpr double step = 1e-6;
  for (const double t : {1e-3, 4e-3, 8e-3}) {
    const auto a = ellipsoid_axes(rates, t);
    EXPECT_NEAR(a[0] * a[1] * a[2], 1.0, 1e-9);
    const auto before = ellipsoid_axes(rates, t - step), after = ellipsoid_axes(rates, t + step);
    double energy = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      energy += std::pow((after[i] - before[i]) / (2.0 * step), 2);
    EXPECT_NEAR(energy / (1e4 + 4.9e3 + 0.9e3), 1.0, 1e-6);
  }
  EXPECT_EQ(ellipsoid_axes({0.0, 0.0, 0.0}, 1.0), (std::array<double, 3>{1.0, 1.0, 1.0}));
}

TEST(ExactWave, FrequencyInDeepAndShallowWater) {
  EXPECT_NEAR(wave_frequency(9.81, 2.0, 50.0), std::sqrt(9.81 * 2.0), 1e-12);
  EXPECT_NEAR(wave_frequency(9.81, 1e-4, 1.0), 1e-4 * std::sqrt(9.81), 1e-11);
}

// 2 nu int D:D over twice the mean energy, of the potential cos kx cosh ky at kh = 1.2.
TEST(ExactWave, DecayIsTheDissipationOfItsPotentialFlow) {
  const double k = pi;
  const double h = 1.2 / pi;
  const double nu = 0.003;
  const auto over_depth = [&](auto&& f) { return integral(0.0, h, f); };
  // cos^2 and sin^2 have the same mean over the width; velocities k (-sin cosh, cos sinh).
  const double kinetic = 0.25 * k * k * over_depth([&](double y) {
                           return std::pow(std::cosh(k * y), 2) + std::pow(std::sinh(k * y), 2);
                         });
  const double deformation = std::pow(k, 4) * over_depth([&](double y) {
                               return std::pow(std::cosh(k * y), 2) + std::pow(std::sinh(k * y), 2);
                             });
  // Mean over a period: half the largest dissipation over an energy equal to the largest kinetic
  // one; the amplitude decays half as fast as the energy.
  const double rate = 0.5 * (0.5 * 2.0 * nu * deformation) / kinetic;
  EXPECT_NEAR(wave_decay(nu, k), rate, 1e-6 * rate);
}

TEST(ExactChannel, SolvesItsEquation) {
  const double force = 0.8;
  const double nu = 0.1;
  const double d = 1e-3;
  const auto u = [&](double y, double t) { return channel_speed(force, nu, 2.0, y, t); };
  for (const double y : {0.2, 0.9, 1.6}) {
    const double rate = (u(y, 0.5 + d) - u(y, 0.5 - d)) / (2.0 * d);
    const double bend = (u(y + d, 0.5) - 2.0 * u(y, 0.5) + u(y - d, 0.5)) / (d * d);
    EXPECT_NEAR(rate, force + nu * bend, 1e-5);
    EXPECT_NEAR(u(y, 0.0), 0.0, 1e-4);
  }
  EXPECT_NEAR(u(0.0, 0.7), 0.0, 1e-12);
  EXPECT_NEAR(u(2.0, 0.7), 0.0, 1e-12);
  EXPECT_NEAR(u(1.0, 1e3), force * 4.0 / (8.0 * nu), 1e-12);
}

// The pressure of the patch is the stress function of a bar in torsion, whose constant for a square
// is tabulated: 0.1406 L^4 (Timoshenko & Goodier, Theory of Elasticity, Sec. 109), four times our
// integral over the source.
TEST(ExactPatch, AgreesWithTheTorsionOfASquareBar) {
  EXPECT_NEAR(patch_spreading(), 1.0 - 6.0 * 0.1406, 2e-4);
}

TEST(FitDampedWave, FindsWhatTheSamplesWereMadeOf) {
  std::vector<double> t, y;
  for (int i = 0; i <= 150; ++i) {
    t.push_back(0.02 * i);
    y.push_back(0.7 * std::exp(-0.11 * t.back()) * std::sin(5.4 * t.back() + 0.2));
  }
  const DampedWave fit = fit_damped_wave(t, y, 5.1);
  EXPECT_NEAR(fit.omega, 5.4, 1e-6);
  EXPECT_NEAR(fit.decay, 0.11, 1e-6);
  EXPECT_NEAR(fit.amplitude, 0.7, 1e-6);
  EXPECT_NEAR(fit.phase, 0.2, 1e-6);
  EXPECT_THROW(static_cast<void>(fit_damped_wave({0.0, 1.0}, {0.0, 1.0}, 5.0)), surge::Error);
}

}  // namespace
}  // namespace surge::compare
