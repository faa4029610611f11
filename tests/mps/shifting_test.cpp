#include <gtest/gtest.h>

#include <cmath>

#include "particle/mps/free_surface.hpp"
#include "particle/mps/number_density.hpp"
#include "particle/mps/shifting.hpp"
#include "tests/mps/lattice.hpp"

namespace surge::mps {
namespace {

using testing::everyone;
using testing::l0;
using testing::Lattice;

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

TEST(Shifting, RelativeSpeedIsTheRootMeanSquare) {
  const Lattice<2> lattice(4, 3.1 * l0);
  std::array<Field, 2> v{lattice.x[0], lattice.x[1]};
  for (std::size_t j = 0; j < v[0].size(); ++j) {
    v[0][j] = j == lattice.middle ? 10.0 : 10.0 + 3.0 * std::cos(static_cast<double>(j));
    v[1][j] = j == lattice.middle ? -2.0 : -2.0 + 3.0 * std::sin(static_cast<double>(j));
  }
  const Displacement<2> displacement(lattice.x, {});
  const auto neighbours = lattice.list.of(lattice.middle);
  const auto found = [&](const auto& counts) {
    return surroundings<2>(lattice.middle, neighbours, displacement, 3.1 * l0,
                           reference_number_density<2>(3.1), 0.3, v, counts);
  };
  EXPECT_NEAR(found(everyone).relative_speed, 3.0, 1e-12);
  const auto nobody = [](std::size_t) { return false; };
  EXPECT_EQ(found(nobody).relative_speed, 0.0);
  EXPECT_FALSE(found(nobody).velocity_gradient.has_value());
}

// One pass gives what the models one by one do, and the exact gradient of a linear velocity.
TEST(Shifting, SurroundingsAreThoseOfTheModels) {
  const double re = 3.1;
  const double n0 = reference_number_density<3>(re);
  const Lattice<3> lattice = testing::jittered<3>(re * l0);
  const Displacement<3> displacement(lattice.x, {});
  const auto neighbours = lattice.list.of(lattice.middle);
  std::array<Field, 3> v{lattice.x[0], lattice.x[0], lattice.x[2]};
  for (std::size_t j = 0; j < v[0].size(); ++j) v[1][j] += 5.0 * lattice.x[1][j];
  const auto fluid = [](std::size_t j) { return j % 5 != 0; };
  const Surroundings<3> found =
      surroundings<3>(lattice.middle, neighbours, displacement, re * l0, n0, 0.1, v, fluid);
  const Vec<3> concentration =
      concentration_gradient<3>(lattice.middle, neighbours, displacement, re * l0, n0);
  ASSERT_TRUE(found.velocity_gradient.has_value());
  const std::array<Vec<3>, 3> exact{Vec<3>{1.0, 0.0, 0.0}, {1.0, 5.0, 0.0}, {0.0, 0.0, 1.0}};
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(found.concentration_gradient[a] * l0, concentration[a] * l0, 1e-12);
    for (std::size_t b = 0; b < 3; ++b)
      EXPECT_NEAR((*found.velocity_gradient)[a][b], exact[a][b], 1e-10);
  }
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

}  // namespace
}  // namespace surge::mps
