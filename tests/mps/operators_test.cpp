#include <gtest/gtest.h>

#include <cmath>

#include "particle/mps/collision.hpp"
#include "particle/mps/gradient.hpp"
#include "particle/mps/laplacian.hpp"
#include "particle/mps/number_density.hpp"

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
  const double by_hand = 4.0 * (2.1 / 1.0 - 1.0) + 4.0 * (2.1 / std::sqrt(2.0) - 1.0) + 4.0 * (2.1 / 2.0 - 1.0);
  EXPECT_NEAR(reference_number_density<2>(2.1), by_hand, 1e-12);
  const Lattice<2> lattice(5, 2.1 * l0);
  const Displacement<2> displacement(lattice.x, {});
  EXPECT_NEAR(number_density<2>(lattice.middle, lattice.list.of(lattice.middle), displacement, 2.1 * l0), by_hand,
              1e-11);
}

TEST(NumberDensity, OfTheCubicLattice) {
  const double by_hand = 6.0 * 1.1 + 12.0 * (2.1 / std::sqrt(2.0) - 1.0) + 8.0 * (2.1 / std::sqrt(3.0) - 1.0) +
                         6.0 * (2.1 / 2.0 - 1.0);
  EXPECT_NEAR(reference_number_density<3>(2.1), by_hand, 1e-12);
  const Lattice<3> lattice(4, 2.1 * l0);
  const Displacement<3> displacement(lattice.x, {});
  EXPECT_NEAR(number_density<3>(lattice.middle, lattice.list.of(lattice.middle), displacement, 2.1 * l0), by_hand,
              1e-11);
}

// Errata of the paper, Eq. (8), at its re = 4 l0 and l0 = 0.005 m.
TEST(Lambda, LatticeAnalyticAndPrinted) {
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::lattice, 4.0, l0)), 9.27e-5, 0.01e-5);
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::analytic, 4.0, l0)), 6.667e-5, 0.001e-5);
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::paper, 4.0, l0)), 3.333e-5, 0.001e-5);
  // The sum tends to the integral as the radius grows.
  const double wide = 60.0;
  EXPECT_NEAR((laplacian_lambda<2>(Lambda::lattice, wide, l0) / laplacian_lambda<2>(Lambda::analytic, wide, l0)), 1.0,
              0.03);
}

template <int D>
void expect_exact_laplacian() {
  const double re = 4.0;
  const Lattice<D> lattice(5, re * l0);
  const Displacement<D> displacement(lattice.x, {});
  const double factor =
      laplacian_factor<D>(reference_number_density<D>(re), laplacian_lambda<D>(Lambda::lattice, re, l0));
  const auto laplacian = [&](auto&& phi) {
    return factor * laplacian_sum<D>(lattice.middle, lattice.list.of(lattice.middle), displacement, re * l0, phi, everyone);
  };
  const auto& x = lattice.x;
  const double linear = laplacian([&](std::size_t j) { return 3.0 + 2.0 * x[0][j] - 7.0 * x[D - 1][j]; });
  EXPECT_NEAR(linear, 0.0, 1e-8);
  const double quadratic = laplacian([&](std::size_t j) {
    double sum = 0.0;
    for (int a = 0; a < D; ++a) sum += x[a][j] * x[a][j];
    return sum;
  });
  EXPECT_NEAR(quadratic, 2.0 * D, 1e-9);
}

// With lambda from the lattice the model is exact for r^2, which defines lambda.
TEST(Laplacian, ExactOnLinearAndQuadraticFields2D) { expect_exact_laplacian<2>(); }
TEST(Laplacian, ExactOnLinearAndQuadraticFields3D) { expect_exact_laplacian<3>(); }

template <int D>
void expect_exact_gradient() {
  const double re = 2.1;
  const Lattice<D> lattice(4, re * l0);
  const Displacement<D> displacement(lattice.x, {});
  const double n0 = reference_number_density<D>(re);
  const auto phi = [&](std::size_t j) { return 5.0 + 3.0 * lattice.x[0][j] - 2.0 * lattice.x[D - 1][j]; };
  // On a full lattice the reference value drops out: the directions sum to zero.
  for (const double reference : {phi(lattice.middle), -100.0}) {
    const Vec<D> g = gradient<D>(lattice.middle, lattice.list.of(lattice.middle), displacement, re * l0, n0, reference,
                                 phi, everyone);
    EXPECT_NEAR(g[0], 3.0, 1e-8);
    EXPECT_NEAR(g[D - 1], -2.0, 1e-8);
  }
}

TEST(Gradient, ExactOnLinearFields2D) { expect_exact_gradient<2>(); }
TEST(Gradient, ExactOnLinearFields3D) { expect_exact_gradient<3>(); }

TEST(Gradient, MinimumIsTakenOverTheNeighbourhoodAndItself) {
  const Lattice<2> lattice(4, 2.1 * l0);
  const Displacement<2> displacement(lattice.x, {});
  const auto neighbours = lattice.list.of(lattice.middle);
  const auto slope = [&](std::size_t j) { return lattice.x[0][j] / l0; };
  EXPECT_NEAR((neighbourhood_minimum<2>(lattice.middle, neighbours, displacement, 2.1 * l0, slope, everyone)), -2.0, 1e-12);
  const auto dip = [&](std::size_t j) { return j == lattice.middle ? -9.0 : slope(j); };
  EXPECT_EQ((neighbourhood_minimum<2>(lattice.middle, neighbours, displacement, 2.1 * l0, dip, everyone)), -9.0);
  const auto right_half = [&](std::size_t j) { return lattice.x[0][j] > -0.5 * l0; };
  EXPECT_NEAR((neighbourhood_minimum<2>(lattice.middle, neighbours, displacement, 2.1 * l0, slope, right_half)), 0.0, 1e-12);
}

// With the minimum as reference every neighbour pushes: the correction never pulls particles together.
TEST(Gradient, MinimumMakesEveryPairRepel) {
  std::array<Field, 2> x{Field{0.0, 0.6 * l0}, Field{0.0, 0.0}};
  const std::array<std::uint32_t, 1> neighbour{1};
  const Displacement<2> displacement(x, {});
  const Field p{800.0, 300.0};
  const auto phi = [&](std::size_t j) { return p[j]; };
  const Vec<2> g = gradient<2>(0, neighbour, displacement, 2.1 * l0, 6.0, 300.0, phi, everyone);
  EXPECT_GE(g[0], 0.0);
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
  const Vec<2> first = model.velocity_change(0, of_first, displacement, v, nobody, count);
  const Vec<2> second = model.velocity_change(1, of_second, displacement, v, nobody, count);
  EXPECT_EQ(count, 2);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(first[a] + second[a], 0.0, 1e-15);
  const Vec<2> d = displacement(0, 1);
  const auto normal_speed = [&](double dvx, double dvy) { return (dvx * d[0] + dvy * d[1]) / std::sqrt(squared_norm<2>(d)); };
  const double before = normal_speed(v[0][1] - v[0][0], v[1][1] - v[1][0]);
  const double after = normal_speed(v[0][1] + second[0] - v[0][0] - first[0], v[1][1] + second[1] - v[1][0] - first[1]);
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
  const Vec<2> change = model.velocity_change(0, neighbour, displacement, v, second_is_wall, count);
  EXPECT_NEAR(change[0], -2.0, 1e-14);
  EXPECT_NEAR(change[1], 0.0, 1e-14);
  v[0][0] = -2.0;
  EXPECT_EQ(model.velocity_change(0, neighbour, displacement, v, second_is_wall, count)[0], 0.0);
  EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace surge::mps
