#include "particle/linear/grid_multigrid.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/linear/pressure_solver.hpp"
#include "particle/support/error.hpp"
#include "tests/linear/poisson_fixture.hpp"

namespace surge::linear {
namespace {

using testing::largest_difference;
using testing::Lattice;
using testing::LatticeSystem;
using testing::noise;

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

// One that has only known pressures around, and lies a hair beside the corner of a grid cell.
TEST_F(Multigrid, SolvesARowThatStandsAlone) {
  Lattice lattice{.counts = {8, 8, 12}, .dimension = 3, .jitter = 0.2, .radius = 3.1};
  for (const double beside : {0.0, 1e-3, 1e-5, 1e-6, 3e-7, 1e-7, 1e-8}) {
    PoissonSystem system = LatticeSystem(lattice).system;
    const double width = 0.75 * 3.1;  // of a cell; the middle of all is a corner
    for (Field& x : system.x) {
      const double low = *std::min_element(x.begin(), x.end());
      x.push_back(low + width * (18.0 + beside));
    }
    system.diagonal.push_back(0.01);
    system.row_start.push_back(system.row_start.back());
    system.rhs = noise(system.size());
    Field p;
    EXPECT_TRUE(solve(system, p, 3.1, 1e-10).converged);
    EXPECT_NEAR(p.back(), system.rhs.back() / 0.01, 1e-6 * std::abs(p.back()));
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

// The same flow at the other end: what the solver leaves of the residual is in the mirror as well,
// but for the single precision of the preconditioner.
TEST_F(Multigrid, HasNoSide) {
  for (const int dimension : {2, 3}) {
    for (const int width : {21, 22, 37}) {  // an odd number has a column on the grid's middle line
      Lattice lattice{.counts = {width, dimension == 2 ? 40 : 12, dimension == 2 ? 1 : 14},
                      .dimension = dimension,
                      .radius = 3.1};
      for (const double jitter : {0.0, 0.2}) {
        lattice.jitter = jitter;
        PoissonSystem system = LatticeSystem(lattice).system;
        system.rhs = noise(system.size());
        PoissonSystem other = testing::in_reverse(system);
        for (double& x : other.x[0]) x = 100.3 - x;
        Field p;
        Field q;
        const SolveReport here = solve(system, p, 3.1, 1e-3);
        const SolveReport there = solve(other, q, 3.1, 1e-3);
        EXPECT_EQ(here.iterations, there.iterations);
        EXPECT_GT(here.residual, 1e-5);
        std::reverse(q.begin(), q.end());
        const double largest = largest_difference(p, Field(p.size(), 0.0));
        EXPECT_LT(largest_difference(p, q), 1e-7 * largest) << dimension << "D, " << width;
      }
    }
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

// Rounded to float, the coarsest operator may have a pivot below zero, whose root is not a number.
TEST(CoarsestGrid, ThatRoundingMadeIndefiniteIsShifted) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << 1.0, 1.0 + 1e-7, 1.0 + 1e-7, 1.0;
  Eigen::LLT<Eigen::MatrixXd> factor;
  factorise_shifted(matrix, factor);
  ASSERT_EQ(factor.info(), Eigen::Success);
  // In the direction that the matrix can tell, the inverse is that of the matrix: 1 / (2 + 1e-7).
  const Eigen::Vector2d x = factor.solve(Eigen::Vector2d(1.0, 1.0));
  EXPECT_NEAR(x[0], 0.5, 1e-5);
  EXPECT_NEAR(x[1], 0.5, 1e-5);
  matrix << 2.0, 0.0, 0.0, 4.0;  // what needs no shift gets none
  factorise_shifted(matrix, factor);
  EXPECT_DOUBLE_EQ(factor.matrixL()(1, 1), 2.0);
  matrix(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(factorise_shifted(matrix, factor), Error);
  EXPECT_THROW(factorise_shifted(Eigen::MatrixXd::Zero(2, 2), factor), Error);
}

}  // namespace
}  // namespace surge::linear
