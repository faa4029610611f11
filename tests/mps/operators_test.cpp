#include <gtest/gtest.h>

#include <cmath>

#include "particle/mps/collision.hpp"
#include "particle/mps/free_surface.hpp"
#include "particle/mps/gradient.hpp"
#include "particle/mps/laplacian.hpp"
#include "particle/mps/number_density.hpp"
#include "particle/mps/pressure_poisson.hpp"
#include "particle/mps/shifting.hpp"
#include "particle/mps/velocity_divergence.hpp"

namespace surge::mps {
namespace {

constexpr double l0 = 0.005;

/// A square (cubic) lattice of odd width with its middle particle, neighbours found by cells.
template <int D>
struct Lattice {
  explicit Lattice(int half, double radius) {
    const int width = 2 * half + 1;
    int n = 1;
    for (int a = 0; a < D; ++a) n *= width;
    for (int k = 0; k < n; ++k) {
      int rest = k;
      for (int a = 0; a < D; ++a) {
        x[a].push_back((rest % width - half) * l0);
        rest /= width;
      }
    }
    CellGrid<D> grid(Search::cell_grid, {});
    grid.build(x, radius, 2);
    for (int a = 0; a < D; ++a) grid.reorder(x[a]);
    list.build(grid, x, radius, [](std::size_t) { return true; });
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      double r2 = 0.0;
      for (int a = 0; a < D; ++a) r2 += x[a][i] * x[a][i];
      if (r2 < 1e-12) middle = i;
    }
  }
  std::array<Field, D> x;
  NeighbourList<D> list;
  std::size_t middle = 0;
};

const auto everyone = [](std::size_t) { return true; };

TEST(NumberDensity, OfTheLatticeByHand) {
  // re = 2.1: 4 neighbours at 1, 4 at sqrt 2, 4 at 2.
  const double by_hand =
      4.0 * (2.1 / 1.0 - 1.0) + 4.0 * (2.1 / std::sqrt(2.0) - 1.0) + 4.0 * (2.1 / 2.0 - 1.0);
  EXPECT_NEAR(reference_number_density<2>(2.1), by_hand, 1e-12);
  const Lattice<2> lattice(5, 2.1 * l0);
  const Displacement<2> displacement(lattice.x, {});
  EXPECT_NEAR(
      number_density<2>(lattice.middle, lattice.list.of(lattice.middle), displacement, 2.1 * l0),
      by_hand, 1e-11);
}

TEST(NumberDensity, OfTheCubicLattice) {
  const double by_hand = 6.0 * 1.1 + 12.0 * (2.1 / std::sqrt(2.0) - 1.0) +
                         8.0 * (2.1 / std::sqrt(3.0) - 1.0) + 6.0 * (2.1 / 2.0 - 1.0);
  EXPECT_NEAR(reference_number_density<3>(2.1), by_hand, 1e-12);
  const Lattice<3> lattice(4, 2.1 * l0);
  const Displacement<3> displacement(lattice.x, {});
  EXPECT_NEAR(
      number_density<3>(lattice.middle, lattice.list.of(lattice.middle), displacement, 2.1 * l0),
      by_hand, 1e-11);
}

// Errata of the paper, Eq. (8), at its re = 4 l0 and l0 = 0.005 m.
TEST(Lambda, LatticeAnalyticAndPrinted) {
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::lattice, 4.0, l0)), 9.27e-5, 0.01e-5);
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::analytic, 4.0, l0)), 6.667e-5, 0.001e-5);
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::paper, 4.0, l0)), 3.333e-5, 0.001e-5);
  // The sum tends to the integral as the radius grows.
  const double wide = 60.0;
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::lattice, wide, l0) /
               laplacian_lambda<2>(Lambda::analytic, wide, l0)),
              1.0, 0.03);
}

template <int D>
void expect_exact_laplacian() {
  const double re = 4.0;
  const Lattice<D> lattice(5, re * l0);
  const Displacement<D> displacement(lattice.x, {});
  const double factor = laplacian_factor<D>(reference_number_density<D>(re),
                                            laplacian_lambda<D>(Lambda::lattice, re, l0));
  const auto laplacian = [&](auto&& phi) {
    return factor * laplacian_sum<D>(lattice.middle, lattice.list.of(lattice.middle), displacement,
                                     re * l0, phi, everyone);
  };
  const auto& x = lattice.x;
  const double linear =
      laplacian([&](std::size_t j) { return 3.0 + 2.0 * x[0][j] - 7.0 * x[D - 1][j]; });
  EXPECT_NEAR(linear, 0.0, 1e-8);
  const double quadratic = laplacian([&](std::size_t j) {
    double sum = 0.0;
    for (int a = 0; a < D; ++a) sum += x[a][j] * x[a][j];
    return sum;
  });
  EXPECT_NEAR(quadratic, 2.0 * D, 1e-9);
}

// With lambda from the lattice the model is exact for r^2, which defines lambda.
TEST(Laplacian, ExactOnLinearAndQuadraticFields2D) {
  expect_exact_laplacian<2>();
}
TEST(Laplacian, ExactOnLinearAndQuadraticFields3D) {
  expect_exact_laplacian<3>();
}

/// (D + 2) sum (v_ij . e) e w times the Laplacian's factor at the middle of a wide lattice.
template <int D, class V>
Vec<D> deformation(V&& velocity) {
  const double re = D == 2 ? 8.1 : 5.1;
  const Lattice<D> lattice(D == 2 ? 9 : 6, re * l0);
  const Displacement<D> displacement(lattice.x, {});
  std::array<Field, D> v;
  for (std::size_t i = 0; i < lattice.x[0].size(); ++i) {
    Vec<D> x;
    for (int a = 0; a < D; ++a) x[a] = lattice.x[a][i];
    const Vec<D> value = velocity(x);
    for (int a = 0; a < D; ++a) v[a].push_back(value[a]);
  }
  Vec<D> sum = deformation_sum<D>(lattice.middle, lattice.list.of(lattice.middle), displacement,
                                  re * l0, v, everyone);
  const double factor = laplacian_factor<D>(reference_number_density<D>(re),
                                            laplacian_lambda<D>(Lambda::lattice, re, l0));
  for (double& component : sum) component *= factor;
  return sum;
}

// lap v + 2 grad div v. The lattice is not isotropic, and the less so the wider the radius.
template <int D>
void expect_deformation() {
  const Vec<D> shear = deformation<D>([](const Vec<D>& x) { return Vec<D>{x[1] * x[1]}; });
  EXPECT_NEAR(shear[0], 2.0, 0.03 * 2.0);
  EXPECT_NEAR(shear[1], 0.0, 1e-9);
  const Vec<D> squeeze = deformation<D>([](const Vec<D>& x) { return Vec<D>{x[0] * x[0]}; });
  EXPECT_NEAR(squeeze[0], 6.0, 0.03 * 6.0);
  const Vec<D> turn = deformation<D>([](const Vec<D>& x) { return Vec<D>{-x[1], x[0]}; });
  EXPECT_NEAR(turn[0], 0.0, 1e-9);
  EXPECT_NEAR(turn[1], 0.0, 1e-9);
}

TEST(DeformationSum, OfShearSqueezeAndRotation2D) {
  expect_deformation<2>();
}
TEST(DeformationSum, OfShearSqueezeAndRotation3D) {
  expect_deformation<3>();
}

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

/// The lattice with every particle moved by up to 0.2 l0, the same way in each run.
template <int D>
Lattice<D> jittered(double radius) {
  Lattice<D> lattice(5, radius);
  unsigned state = 12345;
  for (int a = 0; a < D; ++a)
    for (double& x : lattice.x[a]) {
      state = state * 1664525u + 1013904223u;
      x += (static_cast<double>(state >> 8) / (1u << 24) - 0.5) * 0.4 * l0;
    }
  return lattice;
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

template <int D>
void expect_divergence_exact() {
  const double re = 3.1;
  const Lattice<D> lattice(4, re * l0);
  const Displacement<D> displacement(lattice.x, {});
  std::array<Field, D> v;
  for (std::size_t j = 0; j < lattice.x[0].size(); ++j) {
    for (int a = 0; a < D; ++a) v[a].push_back((a + 1.0) * lattice.x[a][j]);
    v[0].back() += 7.0 * lattice.x[1][j];  // shear has no divergence
  }
  const auto relative = [&](std::size_t j) {
    Vec<D> difference;
    for (int a = 0; a < D; ++a) difference[a] = v[a][j] - v[a][lattice.middle];
    return difference;
  };
  const double divergence =
      velocity_divergence<D>(lattice.middle, lattice.list.of(lattice.middle), displacement, re * l0,
                             reference_number_density<D>(re), relative, everyone);
  EXPECT_NEAR(divergence, D * (D + 1) / 2.0, 1e-10);
}

TEST(VelocityDivergence, ExactOnLinearFields2D) {
  expect_divergence_exact<2>();
}
TEST(VelocityDivergence, ExactOnLinearFields3D) {
  expect_divergence_exact<3>();
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

TEST(Shifting, LeavesALatticeAlone) {
  const double re = 3.1;
  const Lattice<2> lattice(4, re * l0);
  const Vec<2> gradient = concentration_gradient<2>(lattice.middle, lattice.list.of(lattice.middle),
                                                    Displacement<2>(lattice.x, {}), re * l0,
                                                    reference_number_density<2>(re));
  EXPECT_NEAR(gradient[0] * l0, 0.0, 1e-12);
  EXPECT_NEAR(gradient[1] * l0, 0.0, 1e-12);
}

// A particle that was moved off its place in a lattice is sent back, not past it.
TEST(Shifting, EvensOutADisplacement) {
  const double re = 3.1;
  Lattice<2> lattice(4, re * l0);
  lattice.x[0][lattice.middle] = 0.2 * l0;
  const Vec<2> gradient = concentration_gradient<2>(lattice.middle, lattice.list.of(lattice.middle),
                                                    Displacement<2>(lattice.x, {}), re * l0,
                                                    reference_number_density<2>(re));
  const Vec<2> s = shift<2>(gradient, {}, 1.0, l0, 0.2 * l0);
  EXPECT_LT(s[0], -0.01 * l0);
  EXPECT_GT(s[0], -0.2 * l0);
  EXPECT_NEAR(s[1], 0.0, 1e-12 * l0);
}

TEST(Shifting, KeepsToTheSurface) {
  const Vec<2> normal{3.0, 4.0};
  const Vec<2> s = shift<2>({1.0, 0.5}, normal, 0.5, l0, 1e-3);
  EXPECT_NEAR(s[0] * normal[0] + s[1] * normal[1], 0.0, 1e-18);
  // Along the surface nothing is lost: (1, 0.5) on the tangent (4, -3)/5 is 0.5.
  EXPECT_NEAR(std::hypot(s[0], s[1]), 0.5 * l0 * 1e-3 * 0.5, 1e-18);
}

TEST(MixedSource, GammaWeighsDivergenceAgainstDensity) {
  const double rho = 1000.0;
  const double dt = 1e-3;
  EXPECT_NEAR(mixed_source(0.0, 6.6, 6.0, rho, dt, 1.0), rho / (dt * dt) * 0.1, 1e-3);  // Eq. (12)
  EXPECT_NEAR(mixed_source(-2.0, 6.6, 6.0, rho, dt, 0.0), 2.0 * rho / dt, 1e-6);
  EXPECT_NEAR(mixed_source(-2.0, 6.6, 6.0, rho, dt, 0.01),
              0.99 * 2.0 * rho / dt + 0.01 * 0.1 * rho / (dt * dt), 1e-3);
}

// Weights are stored in single precision. The diagonal is the sum of what is stored, so that a row
// without p = 0 neighbours has no excess at all, however coarse the weights are.
TEST(PoissonAssembly, RoundedWeightsLeaveNoExcess) {
  const double re = 3.1 * l0;
  const double factor = 0.7 / (l0 * l0);
  Lattice<2> lattice(5, re);
  Particles<2> p;
  p.resize(lattice.x[0].size());
  p.x = lattice.x;
  for (std::size_t i = 0; i < p.size(); ++i) p.x[0][i] += 0.01 * l0 * std::sin(3.0 * double(i));
  AlignedVector<std::int32_t> unknown(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)  // the middle particle has p = 0
    unknown[i] = i == lattice.middle ? -1 : static_cast<std::int32_t>(i - (i > lattice.middle));
  const Displacement<2> displacement(p.x, {});
  PoissonAssembly<2> assembly(re, factor, l0);
  const linear::PoissonSystem& system =
      assembly.assemble(p, lattice.list, displacement, unknown, p.size() - 1);
  Field excess;
  compute_excess(system, excess);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (i == lattice.middle) continue;
    const auto row = static_cast<std::size_t>(unknown[i]);
    auto entry = static_cast<std::size_t>(system.row_start[row]);
    double to_middle = 0.0;
    for (const std::uint32_t j : lattice.list.of(i)) {
      const double exact = factor * mps_weight(std::sqrt(squared_norm<2>(displacement(i, j))), re);
      if (j == lattice.middle) {
        to_middle = exact;
        continue;
      }
      ASSERT_EQ(system.column[entry], unknown[j]);
      EXPECT_NEAR(static_cast<double>(system.value[entry]), -exact, 6e-8 * exact);
      ++entry;
    }
    EXPECT_NEAR(excess[row], to_middle, 1e-7 * to_middle + 1e-11 * system.diagonal[row]);
    if (to_middle == 0.0) {
      EXPECT_EQ(excess[row], 0.0);
    }
  }
}

// Square lattice by hand: the first layer of the surface and the second, on either side of 0.3.
TEST(FreeSurface, OffsetTellsTheFirstLayerFromTheSecond) {
  for (const double re : {2.1, 3.1}) {
    const double n0 = reference_number_density<2>(re);
    const auto by_hand = [&](int first_missing) {
      double sum = 0.0;
      for (int k = -4; k <= 4; ++k)
        for (int m = first_missing; m <= 4; ++m) sum += m * mps_weight(std::hypot(k, m), re);
      return sum / n0;
    };
    for (const int depth : {0, 1}) {
      Lattice<2> lattice(5, re * l0);
      // Particles above the surface go far away.
      for (double& y : lattice.x[1])
        if (y > (depth + 0.5) * l0) y += 1.0;
      const double offset = neighbour_offset<2>(lattice.middle, lattice.list.of(lattice.middle),
                                                Displacement<2>(lattice.x, {}), re * l0, n0, l0);
      EXPECT_NEAR(offset, by_hand(depth + 1), 1e-10);
      if (depth == 0)
        EXPECT_GT(offset, 0.3);
      else
        EXPECT_LT(offset, 0.2);
    }
  }
}

// In a velocity field whose every neighbour moves by 3 m/s relative to the particle.
TEST(Shifting, RelativeSpeedIsTheRootMeanSquare) {
  const Lattice<2> lattice(4, 3.1 * l0);
  std::array<Field, 2> v{lattice.x[0], lattice.x[1]};
  for (std::size_t j = 0; j < v[0].size(); ++j) {
    v[0][j] = j == lattice.middle ? 10.0 : 10.0 + 3.0 * std::cos(static_cast<double>(j));
    v[1][j] = j == lattice.middle ? -2.0 : -2.0 + 3.0 * std::sin(static_cast<double>(j));
  }
  const Displacement<2> displacement(lattice.x, {});
  const auto neighbours = lattice.list.of(lattice.middle);
  EXPECT_NEAR(relative_speed<2>(lattice.middle, neighbours, displacement, 3.1 * l0, v, everyone),
              3.0, 1e-12);
  const auto nobody = [](std::size_t) { return false; };
  EXPECT_EQ(relative_speed<2>(lattice.middle, neighbours, displacement, 3.1 * l0, v, nobody), 0.0);
}

// A layer that is pressed together by e along itself grows by (d - 1) e across, to first order; one
// lattice layer is l0 thick; nothing is thicker than 2 l0.
template <int D>
void expect_thickness_follows() {
  const double re = 3.1;
  const LayerThickness<D> thickness(re * l0, l0);
  for (const double e : {0.0, 1e-4, -1e-4, 0.8}) {
    Lattice<D> lattice(4, re * l0);
    const Field height = lattice.x[D - 1];
    for (int a = 0; a < D - 1; ++a)
      for (double& x : lattice.x[a]) x *= 1.0 - e;
    const auto in_layer = [&](std::size_t j) { return std::abs(height[j]) < 0.5 * l0; };
    const double found = thickness(lattice.middle, lattice.list.of(lattice.middle),
                                   Displacement<D>(lattice.x, {}), in_layer);
    if (e > 0.5) {
      EXPECT_EQ(found, 2.0 * l0);
    } else {
      EXPECT_NEAR(found / l0, 1.0 + (D - 1) * e, 10.0 * e * e + 1e-12) << e;
    }
  }
}

template <int D>
void expect_flat_density() {
  const double re = 3.1;
  Lattice<D> lattice(4, re * l0);
  const Displacement<D> displacement(lattice.x, {});
  const Field height = lattice.x[D - 1];
  double n = 0.0;
  for_each_within<D>(
      lattice.middle, lattice.list.of(lattice.middle), displacement, re * l0,
      [&](std::size_t j) { return height[j] < 0.5 * l0; },
      [&](std::size_t, const Vec<D>&, double r2) { n += mps_weight(std::sqrt(r2), re * l0); });
  const double n0 = reference_number_density<D>(re);
  EXPECT_NEAR(LayerThickness<D>(re * l0, l0).flat_density(n0), n, 1e-10);
}

TEST(LayerThickness, FlatDensityIsThatOfTheTopLayer) {
  expect_flat_density<2>();
  expect_flat_density<3>();
}

TEST(LayerThickness, FollowsTheSpacingAlongTheLayer2D) {
  expect_thickness_follows<2>();
}
TEST(LayerThickness, FollowsTheSpacingAlongTheLayer3D) {
  expect_thickness_follows<3>();
}

TEST(Collision, KeepsMomentumAndSetsTheRelativeSpeed) {
  const double e = 0.2;
  std::array<Field, 2> x{Field{0.0, 0.3 * l0, 5.0 * l0}, Field{0.0, 0.2 * l0, 0.0}};
  std::array<Field, 2> v{Field{1.0, -0.5, 0.0}, Field{0.2, 0.1, 0.0}};
  const Displacement<2> displacement(x, {});
  const CollisionModel<2> model(0.5 * l0, e);
  const auto nobody = [](std::size_t) { return false; };
  long count = 0;
  const std::array<std::uint32_t, 2> of_first{1, 2};
  const std::array<std::uint32_t, 2> of_second{0, 2};
  const Vec<2> first = model.velocity_change(0, of_first, displacement, v, nobody, 0.0, count);
  const Vec<2> second = model.velocity_change(1, of_second, displacement, v, nobody, 0.0, count);
  EXPECT_EQ(count, 2);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(first[a] + second[a], 0.0, 1e-15);
  const Vec<2> d = displacement(0, 1);
  const auto normal_speed = [&](double dvx, double dvy) {
    return (dvx * d[0] + dvy * d[1]) / std::sqrt(squared_norm<2>(d));
  };
  const double before = normal_speed(v[0][1] - v[0][0], v[1][1] - v[1][0]);
  const double after = normal_speed(v[0][1] + second[0] - v[0][0] - first[0],
                                    v[1][1] + second[1] - v[1][0] - first[1]);
  EXPECT_NEAR(after, -e * before, 1e-14);
}

TEST(Collision, FixedParticlesTakeUpTheMomentumAndReceedingPairsPass) {
  std::array<Field, 2> x{Field{0.0, 0.4 * l0}, Field{0.0, 0.0}};
  std::array<Field, 2> v{Field{2.0, 0.0}, Field{1.0, 0.0}};
  const Displacement<2> displacement(x, {});
  const CollisionModel<2> model(0.5 * l0, 0.0);
  const auto second_is_wall = [](std::size_t j) { return j == 1; };
  long count = 0;
  const std::array<std::uint32_t, 1> neighbour{1};
  const Vec<2> change =
      model.velocity_change(0, neighbour, displacement, v, second_is_wall, 1.99, count);
  EXPECT_NEAR(change[0], -2.0, 1e-14);
  EXPECT_NEAR(change[1], 0.0, 1e-14);
  const auto speed_after = [&](double least) {
    return model.velocity_change(0, neighbour, displacement, v, second_is_wall, least, count)[0];
  };
  EXPECT_EQ(speed_after(2.01), 0.0);  // too slow an approach
  v[0][0] = -2.0;
  EXPECT_EQ(speed_after(0.0), 0.0);
  EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace surge::mps
