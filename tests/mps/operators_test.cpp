#include <gtest/gtest.h>

#include <cmath>

#include "particle/mps/laplacian.hpp"
#include "particle/mps/number_density.hpp"
#include "particle/mps/pressure_poisson.hpp"
#include "particle/mps/velocity_divergence.hpp"
#include "tests/mps/lattice.hpp"

namespace surge::mps {
namespace {

using testing::everyone;
using testing::l0;
using testing::Lattice;

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

}  // namespace
}  // namespace surge::mps
