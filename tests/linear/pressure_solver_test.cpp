#include "particle/linear/pressure_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "particle/linear/direct.hpp"
#include "particle/support/error.hpp"
#include "tests/linear/poisson_fixture.hpp"

namespace surge::linear {
namespace {

using testing::Lattice;
using testing::LatticeSystem;

Field noise(std::size_t n, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Field field(n, 0.0);
  for (double& value : field) value = uniform(random);
  return field;
}

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

double largest_difference(const Field& a, const Field& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
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

class Multigrid : public ::testing::Test {
 protected:
  static SolveReport solve(const PoissonSystem& system, Field& p, double re = 4.0,
                           double tolerance = 1e-6) {
    Params params;
    params.solver = Solver::multigrid;
    params.tolerance = tolerance;
    params.radius = re;
    return PressureSolver(params).solve(system, p);
  }
};

TEST_F(Multigrid, NeedsAsManyIterationsForManyParticlesAsForFew) {
  for (const double re : {2.1, 4.0}) {
    std::vector<int> iterations;
    for (const int width : {20, 60, 180}) {
      Lattice lattice{.counts = {width, 2 * width, 1}, .jitter = 0.2, .radius = re};
      PoissonSystem system = LatticeSystem(lattice).system;
      system.rhs = noise(system.size());
      Field p;
      iterations.push_back(solve(system, p, re).iterations);
    }
    EXPECT_LE(iterations.back(), re < 3.0 ? 20 : 13);
    EXPECT_LE(iterations.back(), iterations.front() + 4);
  }
}

TEST_F(Multigrid, NeedsFewIterationsInThreeDimensions) {
  Lattice lattice{.counts = {20, 20, 40}, .dimension = 3, .jitter = 0.2, .radius = 3.1};
  PoissonSystem system = LatticeSystem(lattice).system;
  system.rhs = noise(system.size());
  Field p;
  EXPECT_LE(solve(system, p, 3.1).iterations, 12);
}

TEST_F(Multigrid, GivesTheSameBitsWithAnyNumberOfThreads) {
  PoissonSystem system = LatticeSystem(Lattice{.counts = {150, 300, 1}}).system;
  system.rhs = noise(system.size());
  const int threads = omp_get_max_threads();
  std::vector<Field> solutions;
  for (const int n : {1, 2, 3}) {
    omp_set_num_threads(n);
    solutions.emplace_back();
    solve(system, solutions.back());
  }
  omp_set_num_threads(threads);
  EXPECT_EQ(solutions[0], solutions[1]);
  EXPECT_EQ(solutions[0], solutions[2]);
}

TEST_F(Multigrid, SeesThroughAPeriodicBoundary) {
  for (const int width : {5, 50, 130}) {
    Lattice lattice{.counts = {std::max(width, 9), 100, 1}, .periodic = true};
    PoissonSystem system = LatticeSystem(lattice).system;
    const Field exact = noise(system.size());
    system.rhs = testing::rhs_of(system, exact);
    Field p;
    EXPECT_LE(solve(system, p, 4.0, 1e-10).iterations, 24) << width;
    EXPECT_LT(largest_difference(p, exact), 1e-6);
  }
}

// Spray: most particles have p = 0, the unknowns are alone or in small groups, one of them far off.
TEST_F(Multigrid, SolvesSpray) {
  const PoissonSystem full = LatticeSystem(Lattice{.counts = {80, 80, 1}}).system;
  const Field chance = noise(full.size(), 11);
  std::vector<std::int32_t> number(full.size(), -1);
  std::int32_t count = 0;
  for (std::size_t i = 0; i < full.size(); ++i) number[i] = chance[i] > 0.9 ? count++ : -1;
  PoissonSystem system;
  system.row_start = {0};
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (number[i] < 0) continue;
    for (int k = full.row_start[i]; k < full.row_start[i + 1]; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const std::int32_t j = number[static_cast<std::size_t>(full.column[at])];
      if (j < 0) continue;
      system.column.push_back(j);
      system.value.push_back(full.value[at]);
    }
    system.row_start.push_back(static_cast<std::int32_t>(system.column.size()));
    system.diagonal.push_back(full.diagonal[i]);
    for (std::size_t a = 0; a < 3; ++a) system.x[a].push_back(full.x[a][i]);
  }
  system.row_start.push_back(system.row_start.back());
  system.diagonal.push_back(40.0);
  system.x[0].push_back(3e12);
  system.x[1].push_back(-1e5);
  system.x[2].push_back(0.0);
  const Field exact = noise(system.size());
  system.rhs = testing::rhs_of(system, exact);
  Field p;
  EXPECT_LE(solve(system, p, 4.0, 1e-10).iterations, 24);
  EXPECT_LT(largest_difference(p, exact), 1e-8);
}

TEST_F(Multigrid, ScalesAGuessThatIsFarTooLarge) {
  PoissonSystem system = LatticeSystem(Lattice{}).system;
  const Field exact = noise(system.size());
  system.rhs = testing::rhs_of(system, exact);
  Field p = exact;
  for (double& value : p) value *= 1e4;
  EXPECT_LE(solve(system, p).iterations, 1);
  EXPECT_LT(largest_difference(p, exact), 1e-6);
}

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

TEST(SparseCholesky, AnalysesAGraphOnce) {
  PoissonSystem system = LatticeSystem(Lattice{}).system;
  SparseCholesky cholesky;
  for (int change = 0; change < 3; ++change) {
    for (double& value : system.diagonal) value += 1.0;
    const Field exact = noise(system.size());
    Field x;
    cholesky.factorise(system);
    cholesky.solve(testing::rhs_of(system, exact), x);
    EXPECT_LT(largest_difference(x, exact), 1e-10);
  }
  EXPECT_EQ(cholesky.analyses(), 1);
  cholesky.factorise(LatticeSystem(Lattice{.counts = {11, 12, 1}}).system);
  EXPECT_EQ(cholesky.analyses(), 2);
}

TEST(SparseCholesky, RefusesAnIndefiniteMatrix) {
  PoissonSystem system = LatticeSystem(Lattice{.counts = {8, 8, 1}}).system;
  system.diagonal[5] = -1.0;
  EXPECT_THROW(SparseCholesky().factorise(system), Error);
}

}  // namespace
}  // namespace surge::linear
