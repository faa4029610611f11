#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "particle/core/cell_grid.hpp"
#include "particle/isph/gradient.hpp"
#include "particle/isph/pressure_equation.hpp"
#include "particle/isph/shift.hpp"
#include "particle/isph/surface.hpp"
#include "particle/isph/viscosity.hpp"

namespace surge::isph {
namespace {

/// A block of fluid particles in a lattice, each moved by up to `jitter` spacings.
template <int D>
struct Cloud {
  explicit Cloud(double jitter, int width = 11)
      : model(case_of(), Params{}),
        grid(Search::cell_grid, Periodicity<D>{}),
        displacement_periodicity{} {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-jitter, jitter);
    std::size_t count = 1;
    for (int a = 0; a < D; ++a) count *= static_cast<std::size_t>(width);
    p.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t rest = i;
      for (int a = 0; a < D; ++a) {
        p.x[a][i] =
            l0 * (static_cast<double>(rest % static_cast<std::size_t>(width)) + any(random));
        rest /= static_cast<std::size_t>(width);
      }
      p.id[i] = static_cast<std::int32_t>(i);
    }
    grid.build(p.x, model.radius, 2);
    grid.reorder(p);
    list.build(grid, p.x, model.radius, [](std::size_t) { return true; });
    unknown.assign(count, 0);
  }
  static Case case_of() {
    Case c;
    c.dimension = D;
    c.spacing = l0;
    return c;
  }
  View<D> view() {
    return {model, p, list, unknown, Displacement<D>(p.x, displacement_periodicity), loop};
  }
  /// Whether a particle is so far inside that its kernel is full.
  [[nodiscard]] bool inside(std::size_t i, double margin = 3.5, int width = 11) const {
    for (int a = 0; a < D; ++a)
      if (p.x[a][i] < margin * l0 || p.x[a][i] > (width - 1 - margin) * l0) return false;
    return true;
  }
  /// Inside or on one face; on edges and corners there are too few neighbours.
  [[nodiscard]] bool beside_one_face(std::size_t i) const {
    int faces = 0;
    for (int a = 0; a < D; ++a) faces += p.x[a][i] < 2.5 * l0 || p.x[a][i] > 7.5 * l0 ? 1 : 0;
    return faces <= 1;
  }

  static constexpr double l0 = 0.01;
  Model<D> model;
  Particles<D> p;
  CellGrid<D> grid;
  Periodicity<D> displacement_periodicity;
  NeighbourList<D> list;
  AlignedVector<std::int32_t> unknown;
  BalancedLoop loop;
};

template <class Dimension>
class IsphOperators : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(IsphOperators, Dimensions);

TYPED_TEST(IsphOperators, GradientsOfLinearFieldsAreExactWhereverTheNeighboursAre) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.2);
  const auto view = cloud.view();
  const WendlandC2<D> kernel(cloud.model.h);
  const auto everyone = [](std::size_t) { return true; };
  const auto linear = [&](std::size_t i, int k) {
    double sum = 0.0;
    for (int a = 0; a < D; ++a) sum += (1.0 + a - 0.5 * k) * cloud.p.x[a][i];
    return sum;
  };
  for (std::size_t i = 0; i < cloud.p.size(); ++i) {
    if (!cloud.beside_one_face(i)) continue;
    const Vec<D> g = gradient(
        view, kernel, i, [&](std::size_t j) { return linear(j, 0) - linear(i, 0); }, everyone);
    const auto m = vector_gradient(
        view, kernel, i,
        [&](std::size_t j) {
          Vec<D> change;
          for (int k = 0; k < D; ++k) change[k] = linear(j, k) - linear(i, k);
          return change;
        },
        everyone);
    for (int a = 0; a < D; ++a) EXPECT_NEAR(g[a], 1.0 + a, 1e-10);
    ASSERT_TRUE(m.has_value());
    for (int k = 0; k < D; ++k)
      for (int a = 0; a < D; ++a) EXPECT_NEAR((*m)[k][a], 1.0 + a - 0.5 * k, 1e-10);
  }
}

TYPED_TEST(IsphOperators, GradientOfASingleParticleIsZero) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.0, 1);
  const WendlandC2<D> kernel(cloud.model.h);
  const auto view = cloud.view();
  const Vec<D> g = gradient(
      view, kernel, 0, [](std::size_t) { return 1.0; }, [](std::size_t) { return true; });
  for (int a = 0; a < D; ++a) EXPECT_EQ(g[a], 0.0);
  EXPECT_FALSE(vector_gradient(
      view, kernel, 0, [](std::size_t) { return Vec<D>{}; }, [](std::size_t) { return true; }));
}

// By the neighbours alone: a particle whose own velocity is another sees the same gradient.
TYPED_TEST(IsphOperators, VelocityGradientAroundAParticleIsNotItsOwn) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.2);
  const WendlandC2<D> kernel(cloud.model.h);
  for (std::size_t i = 0; i < cloud.p.size(); ++i)
    for (int a = 0; a < D; ++a)
      cloud.p.v[a][i] = 7.0 + (1.0 + a) * cloud.p.x[0][i] - 0.5 * a * cloud.p.x[1][i];
  long inner = 0;
  for (std::size_t i = 0; i < cloud.p.size(); ++i) {
    const auto view = cloud.view();
    if (!cloud.inside(i)) {
      // On the corners of the block the neighbours are on one side.
      bool corner = true;
      for (int a = 0; a < D; ++a)
        corner = corner && (cloud.p.x[a][i] < 0.5 * cloud.l0 || cloud.p.x[a][i] > 9.5 * cloud.l0);
      if (corner) {
        EXPECT_FALSE(velocity_gradient_around(view, kernel, i).has_value());
      }
      continue;
    }
    ++inner;
    cloud.p.v[0][i] += 3.0;
    const auto gradient = velocity_gradient_around(view, kernel, i);
    cloud.p.v[0][i] -= 3.0;
    ASSERT_TRUE(gradient.has_value());
    for (int a = 0; a < D; ++a) {
      EXPECT_NEAR((*gradient)[a][0], 1.0 + a, 1e-9);
      EXPECT_NEAR((*gradient)[a][1], -0.5 * a, 1e-9);
    }
  }
  EXPECT_GT(inner, 8);
}

// Among particles at rest one that is not is shifted, but gains nothing by it: else spray, whose
// neighbours are on one side, would be thrown out ever faster.
TYPED_TEST(IsphOperators, AShiftGivesNoSpeedToWhatIsTheOnlyOneToMove) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.3);
  Surface<D> surface{Params{}};
  Field lambda(cloud.p.size());
  Field pressure(cloud.p.size());
  surface.find(cloud.view(), WallCollision<D>(cloud.case_of(), 0.0, 0.0), pressure, lambda,
               cloud.unknown, pressure);
  cloud.p.density = lambda;
  Shift<D> shift(2.0);
  std::array<Field, D> moved;
  for (Field& field : moved) field.assign(cloud.p.size(), 0.0);
  long shifted = 0;
  for (std::size_t i = 0; i < cloud.p.size(); i += D == 2 ? 1 : 97) {
    cloud.p.v[0][i] = 1.0;
    auto v = cloud.p.v;
    shift.find(cloud.view(), surface, 1.0, 1e-3, v, moved);
    cloud.p.v[0][i] = 0.0;
    EXPECT_EQ(v[0][i], 1.0);
    EXPECT_EQ(v[1][i], 0.0);
    shifted += moved[0][i] != 0.0 ? 1 : 0;
  }
  EXPECT_GT(shifted, 8);
}

// A p for p = x^2, inside the lattice: -lap p = -2, to the precision in which entries are stored.
TYPED_TEST(IsphOperators, LaplacianOfAQuadraticFieldIsExactOnTheLattice) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.0);
  PressureEquation<D> equation(cloud.model, {});
  for (std::size_t i = 0; i < cloud.p.size(); ++i) cloud.unknown[i] = static_cast<std::int32_t>(i);
  const auto& system = equation.assemble(cloud.view(), cloud.p.size(), {}, {}, 1.0);
  Field p(cloud.p.size());
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = cloud.p.x[0][i] * cloud.p.x[0][i];
  long inner = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!cloud.inside(i)) continue;
    ++inner;
    EXPECT_NEAR(linear::row_product(system, p, i), -2.0, 1e-4);
  }
  EXPECT_GT(inner, 8);
}

TYPED_TEST(IsphOperators, HydrostaticPressureSolvesTheEquationWhereverTheParticlesAre) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.3);
  BodyAcceleration<D> g;
  g.uniform[1] = -9.81;
  g.uniform[0] = 2.0;
  PressureEquation<D> equation(cloud.model, {});
  for (std::size_t i = 0; i < cloud.p.size(); ++i) cloud.unknown[i] = static_cast<std::int32_t>(i);
  // What gravity has just given to the fluid is no divergence.
  for (std::size_t i = 0; i < cloud.p.size(); ++i) cloud.p.v[1][i] = -9.81e-3;
  for (std::size_t i = 0; i < cloud.p.size(); ++i) cloud.p.v[0][i] = 2e-3;
  const auto& system = equation.assemble(cloud.view(), cloud.p.size(), g, {}, 1e-3);
  Field p(cloud.p.size());
  double scale = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i] = cloud.model.rho * (2.0 * cloud.p.x[0][i] - 9.81 * cloud.p.x[1][i]);
    scale = std::max(scale, std::abs(system.rhs[i]));
  }
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_NEAR(linear::row_product(system, p, i), system.rhs[i], 1e-9 * scale);
}

TYPED_TEST(IsphOperators, DivergenceOfALinearVelocityIsTheSource) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.2);
  for (std::size_t i = 0; i < cloud.p.size(); ++i) {
    cloud.unknown[i] = static_cast<std::int32_t>(i);
    cloud.p.v[0][i] = 3.0 * cloud.p.x[0][i] + 5.0 * cloud.p.x[1][i];
    cloud.p.v[1][i] = -1.0 * cloud.p.x[1][i];
  }
  PressureEquation<D> equation(cloud.model, {});
  const double dt = 1e-3;
  const auto& system = equation.assemble(cloud.view(), cloud.p.size(), {}, {}, dt);
  for (std::size_t i = 0; i < cloud.p.size(); ++i) {
    if (!cloud.beside_one_face(i)) continue;
    EXPECT_NEAR(system.rhs[i], -cloud.model.rho / dt * 2.0, 1e-6 * cloud.model.rho / dt);
  }
}

// nu lap v of v = (y^2, 0).
TYPED_TEST(IsphOperators, ViscousTermOfAQuadraticFieldInside) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.0);
  for (std::size_t i = 0; i < cloud.p.size(); ++i)
    cloud.p.v[0][i] = cloud.p.x[1][i] * cloud.p.x[1][i];
  auto v = cloud.p.v;
  Viscosity<D> viscosity;
  viscosity.add(cloud.view(), 0.1, 1.0, v);
  long inner = 0;
  for (std::size_t i = 0; i < cloud.p.size(); ++i) {
    if (!cloud.inside(i)) continue;
    ++inner;
    // A square lattice is not isotropic in the fourth moment: along its axes the term is too weak.
    EXPECT_NEAR(v[0][i] - cloud.p.v[0][i], 0.2, 0.12 * 0.2);
    EXPECT_NEAR(v[1][i], 0.0, 1e-12);
  }
  EXPECT_GT(inner, 8);
}

TYPED_TEST(IsphOperators, OnlyTheFirstLayerOfALatticeIsItsSurface) {
  constexpr int D = TypeParam::value;
  Cloud<D> cloud(0.0);
  Surface<D> surface{Params{}};
  Field lambda(cloud.p.size());
  Field pressure(cloud.p.size(), 5.0);
  Field known(cloud.p.size(), 2.0);
  const std::size_t unknowns =
      surface.find(cloud.view(), WallCollision<D>(cloud.case_of(), 0.0, 0.0), known, lambda,
                   cloud.unknown, pressure);
  std::size_t inner = 0;
  for (std::size_t i = 0; i < cloud.p.size(); ++i) {
    bool first = false;
    for (int a = 0; a < D; ++a) {
      const double x = cloud.p.x[a][i] / cloud.l0;
      first = first || x < 0.5 || x > 9.5;
    }
    EXPECT_EQ(cloud.unknown[i] < 0, first);
    EXPECT_EQ(pressure[i], first ? 2.0 : 5.0);
    inner += first ? 0 : 1;
    if (cloud.inside(i)) {
      EXPECT_NEAR(lambda[i], 1.0, 0.01);
    }
  }
  EXPECT_EQ(unknowns, inner);
}

}  // namespace
}  // namespace surge::isph
