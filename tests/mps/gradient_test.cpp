#include <gtest/gtest.h>

#include <cmath>

#include "particle/mps/gradient.hpp"
#include "particle/mps/number_density.hpp"
#include "particle/mps/velocity_divergence.hpp"
#include "tests/mps/lattice.hpp"

namespace surge::mps {
namespace {

using testing::everyone;
using testing::jittered;
using testing::l0;
using testing::Lattice;

template <int D>
void expect_exact_gradient() {
  const double re = 2.1;
  const Lattice<D> lattice(4, re * l0);
  const Displacement<D> displacement(lattice.x, {});
  const double n0 = reference_number_density<D>(re);
  const auto phi = [&](std::size_t j) {
    return 5.0 + 3.0 * lattice.x[0][j] - 2.0 * lattice.x[D - 1][j];
  };
  // On a full lattice the reference value drops out: the directions sum to zero.
  for (const double reference : {phi(lattice.middle), -100.0}) {
    const Vec<D> g = gradient<D>(lattice.middle, lattice.list.of(lattice.middle), displacement,
                                 re * l0, n0, reference, phi, everyone);
    EXPECT_NEAR(g[0], 3.0, 1e-8);
    EXPECT_NEAR(g[D - 1], -2.0, 1e-8);
  }
}

TEST(Gradient, ExactOnLinearFields2D) {
  expect_exact_gradient<2>();
}
TEST(Gradient, ExactOnLinearFields3D) {
  expect_exact_gradient<3>();
}

TEST(Gradient, MinimumIsTakenOverTheNeighbourhoodAndItself) {
  const Lattice<2> lattice(4, 2.1 * l0);
  const Displacement<2> displacement(lattice.x, {});
  const auto neighbours = lattice.list.of(lattice.middle);
  const auto slope = [&](std::size_t j) { return lattice.x[0][j] / l0; };
  EXPECT_NEAR((neighbourhood_minimum<2>(lattice.middle, neighbours, displacement, 2.1 * l0, slope,
                                        everyone)),
              -2.0, 1e-12);
  const auto dip = [&](std::size_t j) { return j == lattice.middle ? -9.0 : slope(j); };
  EXPECT_EQ(
      (neighbourhood_minimum<2>(lattice.middle, neighbours, displacement, 2.1 * l0, dip, everyone)),
      -9.0);
  const auto right_half = [&](std::size_t j) { return lattice.x[0][j] > -0.5 * l0; };
  EXPECT_NEAR((neighbourhood_minimum<2>(lattice.middle, neighbours, displacement, 2.1 * l0, slope,
                                        right_half)),
              0.0, 1e-12);
}

// With the minimum as reference every neighbour pushes: the correction never pulls particles
// together.
TEST(Gradient, MinimumMakesEveryPairRepel) {
  std::array<Field, 2> x{Field{0.0, 0.6 * l0}, Field{0.0, 0.0}};
  const std::array<std::uint32_t, 1> neighbour{1};
  const Displacement<2> displacement(x, {});
  const Field p{800.0, 300.0};
  const auto phi = [&](std::size_t j) { return p[j]; };
  const Vec<2> g = gradient<2>(0, neighbour, displacement, 2.1 * l0, 6.0, 300.0, phi, everyone);
  EXPECT_GE(g[0], 0.0);
}

template <int D>
void expect_corrected_gradient_exact() {
  const double re = 3.1;
  // The list reaches farther than re, so that it stays complete when particles have moved.
  const Lattice<D> lattice = jittered<D>((re + 0.6) * l0);
  const Displacement<D> displacement(lattice.x, {});
  const double n0 = reference_number_density<D>(re);
  const auto phi = [&](std::size_t j) {
    return 5.0 + 3.0 * lattice.x[0][j] - 2.0 * lattice.x[D - 1][j];
  };
  const auto upper_half = [&](std::size_t j) { return lattice.x[0][j] > -0.5 * l0; };
  const auto neighbours = lattice.list.of(lattice.middle);
  const Vec<D> plain = gradient<D>(lattice.middle, neighbours, displacement, re * l0, n0,
                                   phi(lattice.middle), phi, everyone);
  EXPECT_GT(std::abs(plain[0] - 3.0), 1e-4) << "the plain model errs here";
  const auto all = corrected_gradient<D>(lattice.middle, neighbours, displacement, re * l0, n0, 0.3,
                                         phi, everyone);
  const auto half = corrected_gradient<D>(lattice.middle, neighbours, displacement, re * l0, n0,
                                          0.3, phi, upper_half);
  for (const auto& g : {all, half}) {
    ASSERT_TRUE(g.has_value());
    EXPECT_NEAR((*g)[0], 3.0, 1e-10);
    EXPECT_NEAR((*g)[D - 1], -2.0, 1e-10);
  }
}

TEST(CorrectedGradient, ExactOnLinearFieldsOnAnyParticles2D) {
  expect_corrected_gradient_exact<2>();
}
TEST(CorrectedGradient, ExactOnLinearFieldsOnAnyParticles3D) {
  expect_corrected_gradient_exact<3>();
}

TEST(CorrectedGradient, IsEmptyForNeighboursInALine) {
  const std::array<Field, 2> x{Field{0.0, l0, -l0, 2.0 * l0}, Field{0.0, l0, -l0, 2.0 * l0}};
  const std::array<std::uint32_t, 3> neighbours{1, 2, 3};
  const auto phi = [&](std::size_t j) { return x[0][j]; };
  EXPECT_FALSE((corrected_gradient<2>(0, neighbours, Displacement<2>(x, {}), 3.1 * l0, 6.0, 0.3,
                                      phi, everyone)));
}

// What i gets from j is the opposite of what j gets from i, for any pressures.
TEST(ConservingGradient, SumsToZeroOnAnyParticles) {
  const double re = 2.1;
  const Lattice<2> lattice = jittered<2>((re + 0.6) * l0);
  const Displacement<2> displacement(lattice.x, {});
  const std::size_t n = lattice.x[0].size();
  Field p(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) p[i] = 100.0 + 90.0 * std::sin(static_cast<double>(7 * i));
  const auto phi = [&](std::size_t j) { return p[j]; };
  Field least(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    least[i] =
        neighbourhood_minimum<2>(i, lattice.list.of(i), displacement, re * l0, phi, everyone);
  Vec<2> sum{};
  double size = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<2> g = conserving_gradient<2>(
        i, lattice.list.of(i), displacement, re * l0, 6.5, phi,
        [&](std::size_t j) { return least[j]; }, everyone);
    for (std::size_t a = 0; a < 2; ++a) sum[a] += g[a];
    size += std::sqrt(squared_norm<2>(g));
  }
  for (const double s : sum) EXPECT_NEAR(s, 0.0, 1e-12 * size);
}

/// A stretched lattice of which a corner is missing.
template <int D>
Lattice<D> torn_lattice(double re) {
  Lattice<D> lattice(4, re * l0);
  for (std::size_t j = 0; j < lattice.x[0].size(); ++j) {
    if (lattice.x[0][j] > 0.5 * l0 && lattice.x[1][j] > -0.5 * l0) lattice.x[0][j] += 1.0;
    lattice.x[0][j] *= 0.9;
    lattice.x[1][j] *= 1.2;
  }
  return lattice;
}

template <int D>
void expect_velocity_gradient_exact() {
  const double re = 3.1;
  const Lattice<D> lattice = torn_lattice<D>(re);
  const Displacement<D> displacement(lattice.x, {});
  const auto relative = [&](std::size_t j) {
    const Vec<D> d = displacement(lattice.middle, j);
    Vec<D> v{};
    for (int a = 0; a < D; ++a) v[a] = (a + 1.0) * d[a];
    v[0] += 7.0 * d[1];  // shear has no divergence
    return v;
  };
  const auto neighbours = lattice.list.of(lattice.middle);
  const double n0 = reference_number_density<D>(re);
  const auto gradient = velocity_gradient<D>(lattice.middle, neighbours, displacement, re * l0, n0,
                                             0.1, relative, everyone);
  ASSERT_TRUE(gradient.has_value());
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b)
      EXPECT_NEAR((*gradient)[a][b], a == b ? a + 1.0 : (a == 0 && b == 1 ? 7.0 : 0.0), 1e-10);
  // 1 + 4 (+ 9); the shear adds nothing.
  EXPECT_NEAR(convected_divergence<D>(*gradient), D * (D + 1) * (2 * D + 1) / 6.0, 1e-9);
  // The plain divergence is not exact.
  const double plain = velocity_divergence<D>(lattice.middle, neighbours, displacement, re * l0, n0,
                                              relative, everyone);
  EXPECT_GT(std::abs(plain - D * (D + 1) / 2.0), 0.1);
}

TEST(VelocityGradient, ExactOnLinearFieldsWhereverTheNeighboursAre2D) {
  expect_velocity_gradient_exact<2>();
}
TEST(VelocityGradient, ExactOnLinearFieldsWhereverTheNeighboursAre3D) {
  expect_velocity_gradient_exact<3>();
}

TEST(VelocityGradient, IsNotTrustedOnALine) {
  const Lattice<2> lattice(4, 3.1 * l0);
  const auto on_a_line = [&](std::size_t j) { return std::abs(lattice.x[1][j]) < 0.5 * l0; };
  const auto nothing = [](std::size_t) { return Vec<2>{}; };
  EXPECT_FALSE(velocity_gradient<2>(lattice.middle, lattice.list.of(lattice.middle),
                                    Displacement<2>(lattice.x, {}), 3.1 * l0,
                                    reference_number_density<2>(3.1), 0.3, nothing, on_a_line)
                   .has_value());
}

}  // namespace
}  // namespace surge::mps
