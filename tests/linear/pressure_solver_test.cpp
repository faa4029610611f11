#include "particle/linear/pressure_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "particle/support/error.hpp"
#include "tests/linear/poisson_fixture.hpp"

namespace surge::linear {
namespace {

using testing::largest_difference;
using testing::Lattice;
using testing::LatticeSystem;
using testing::noise;

// Plain Gaussian elimination, which a symmetric positive definite matrix needs no pivots for.
Field dense_solution(const PoissonSystem& system) {
  const std::size_t n = system.size();
  std::vector<Field> a(n, Field(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    a[i][i] = system.diagonal[i];
    for (int k = system.row_start[i]; k < system.row_start[i + 1]; ++k) {
      const auto at = static_cast<std::size_t>(k);
      a[i][static_cast<std::size_t>(system.column[at])] = static_cast<double>(system.value[at]);
    }
  }
  Field x = system.rhs;
  for (std::size_t pivot = 0; pivot < n; ++pivot) {
    for (std::size_t i = pivot + 1; i < n; ++i) {
      const double factor = a[i][pivot] / a[pivot][pivot];
      if (factor == 0.0) continue;
      for (std::size_t j = pivot; j < n; ++j) a[i][j] -= factor * a[pivot][j];
      x[i] -= factor * x[pivot];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) x[i] -= a[i][j] * x[j];
    x[i] /= a[i][i];
  }
  return x;
}

double largest(const Field& a) {
  return largest_difference(a, Field(a.size(), 0.0));
}

class EverySolver : public ::testing::TestWithParam<Solver> {
 protected:
  static Params params(double tolerance = 1e-10) {
    Params params;
    params.solver = GetParam();
    params.tolerance = tolerance;
    return params;
  }
};

TEST_P(EverySolver, AgreesWithADenseSolution) {
  for (const int dimension : {2, 3}) {
    Lattice lattice;
    lattice.dimension = dimension;
    lattice.counts = dimension == 2 ? std::array{20, 30, 1} : std::array{8, 9, 10};
    lattice.radius = dimension == 2 ? 4.0 : 2.1;
    PoissonSystem system = LatticeSystem(lattice).system;
    system.rhs = noise(system.size());
    const Field exact = dense_solution(system);
    Field p;
    Params chosen = params();
    chosen.radius = lattice.radius;
    const SolveReport report = PressureSolver(chosen).solve(system, p);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.residual, 1.01e-10);
    EXPECT_EQ(report.closed_regions, 0);
    EXPECT_LT(largest_difference(p, exact), 1e-7 * largest(exact)) << dimension << "D";
  }
}

TEST_P(EverySolver, ReachesTheToleranceAskedFor) {
  PoissonSystem system = LatticeSystem(Lattice{.counts = {40, 80, 1}}).system;
  system.rhs = noise(system.size());
  for (const double tolerance : {1e-2, 1e-6, 1e-12}) {
    Field p;
    const SolveReport report = PressureSolver(params(tolerance)).solve(system, p);
    EXPECT_TRUE(report.converged);
    BlockSum block_sum;
    const double residual = relative_residual(system, p, block_sum);
    EXPECT_LE(residual, 1.01 * tolerance);
    EXPECT_NEAR(report.residual, residual, 1e-15);
  }
}

TEST_P(EverySolver, KeepsTheExactGuess) {
  PoissonSystem system = LatticeSystem(Lattice{}).system;
  const Field exact = noise(system.size());
  system.rhs = testing::rhs_of(system, exact);
  Field p = exact;
  const SolveReport report = PressureSolver(params()).solve(system, p);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_LT(largest_difference(p, exact), 1e-9);
}

TEST_P(EverySolver, FollowsAChangingSystem) {
  PressureSolver solver(params());
  Field p;
  for (const int width : {20, 24, 24, 10}) {
    Lattice lattice{.counts = {width, 30, 1}};
    lattice.seed = static_cast<unsigned>(width);
    PoissonSystem system = LatticeSystem(lattice).system;
    const Field exact = noise(system.size());
    system.rhs = testing::rhs_of(system, exact);
    solver.solve(system, p);
    EXPECT_LT(largest_difference(p, exact), 1e-6);
  }
}

TEST_P(EverySolver, ZeroRightSideGivesZero) {
  PoissonSystem system = LatticeSystem(Lattice{}).system;
  system.rhs.assign(system.size(), 0.0);
  Field p = noise(system.size());
  const SolveReport report = PressureSolver(params()).solve(system, p);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(largest(p), 0.0);
}

TEST_P(EverySolver, NoUnknownsIsNoWork) {
  PoissonSystem system;
  system.row_start = {0};
  Field p{1.0, 2.0};
  const SolveReport report = PressureSolver(params()).solve(system, p);
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(p.empty());
}

TEST_P(EverySolver, OneUnknown) {
  PoissonSystem system;
  system.row_start = {0, 0};
  system.diagonal = {4.0};
  system.rhs = {2.0};
  system.x = {Field{0.0}, Field{0.0}, Field{0.0}};
  Field p;
  PressureSolver(params()).solve(system, p);
  EXPECT_DOUBLE_EQ(p[0], 0.5);
}

TEST_P(EverySolver, ClosedTankIsSolvedUpToAConstant) {
  PoissonSystem system = LatticeSystem(Lattice{.counts = {20, 30, 1}, .open_rows = 0}).system;
  Field exact = noise(system.size());
  const double lowest = *std::min_element(exact.begin(), exact.end());
  for (double& value : exact) value -= lowest;
  system.rhs = testing::rhs_of(system, exact);
  for (double& value : system.rhs) value += 0.25;  // no solution unless the mean is taken out
  Field p;
  const SolveReport report = PressureSolver(params(1e-11)).solve(system, p);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.closed_regions, 1);
  EXPECT_EQ(*std::min_element(p.begin(), p.end()), 0.0);
  EXPECT_LT(largest_difference(p, exact), 1e-6);
}

// Two tanks side by side, one of them closed, and a particle that nothing touches.
TEST_P(EverySolver, TreatsEachConnectedRegionByItself) {
  PoissonSystem system = LatticeSystem(Lattice{.counts = {12, 14, 1}}).system;
  const PoissonSystem closed = LatticeSystem(Lattice{.counts = {9, 16, 1}, .open_rows = 0}).system;
  const auto first = static_cast<std::int32_t>(system.size());
  const auto entries = static_cast<std::int32_t>(system.column.size());
  for (std::size_t i = 0; i < closed.size(); ++i) {
    system.row_start.push_back(entries + closed.row_start[i + 1]);
    system.diagonal.push_back(closed.diagonal[i]);
    system.x[0].push_back(closed.x[0][i] + 100.0);
    system.x[1].push_back(closed.x[1][i]);
    system.x[2].push_back(0.0);
  }
  for (const std::int32_t j : closed.column) system.column.push_back(first + j);
  system.value.insert(system.value.end(), closed.value.begin(), closed.value.end());
  Field exact = noise(system.size());
  const auto second = exact.begin() + first;
  const double lowest = *std::min_element(second, exact.end());
  std::for_each(second, exact.end(), [&](double& value) { value -= lowest; });
  system.rhs = testing::rhs_of(system, exact);
  system.row_start.push_back(system.row_start.back());
  system.diagonal.push_back(0.0);
  system.rhs.push_back(1.0);
  for (auto& x : system.x) x.push_back(-50.0);
  exact.push_back(0.0);

  Field p;
  const SolveReport report = PressureSolver(params(1e-11)).solve(system, p);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.closed_regions, 2);
  EXPECT_LT(largest_difference(p, exact), 1e-6);
}

TEST_P(EverySolver, RefusesEquationsThatAreNotFinite) {
  PoissonSystem system = LatticeSystem(Lattice{}).system;
  system.rhs = noise(system.size());
  system.rhs[17] = std::numeric_limits<double>::quiet_NaN();
  Field p;
  try {
    PressureSolver(params()).solve(system, p);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("equation 17 is not finite"));
  }
}

std::string name_of(const ::testing::TestParamInfo<Solver>& solver) {
  switch (solver.param) {
    case Solver::iccg:
      return "iccg";
    case Solver::cholmod:
      return "cholmod";
    case Solver::multigrid:
      return "multigrid";
  }
  return "unknown";
}

INSTANTIATE_TEST_SUITE_P(Ppe, EverySolver,
                         ::testing::Values(Solver::iccg, Solver::cholmod, Solver::multigrid),
                         name_of);

TEST(PressureSolver, SaysWhenIterationsRunOut) {
  PoissonSystem system = LatticeSystem(Lattice{}).system;
  system.rhs = noise(system.size());
  Params params;
  params.solver = Solver::iccg;
  params.tolerance = 1e-12;
  params.max_iterations = 2;
  Field p;
  const SolveReport report = PressureSolver(params).solve(system, p);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 2);
  EXPECT_GT(report.residual, 1e-12);
}

TEST(PressureSolver, RefusesImpossibleTolerances) {
  Params params;
  params.tolerance = 0.0;
  EXPECT_THROW(PressureSolver{params}, Error);
  params.tolerance = 1e-6;
  params.max_iterations = 0;
  EXPECT_THROW(PressureSolver{params}, Error);
}

}  // namespace
}  // namespace surge::linear
