#include "particle/mps/linear/iccg.hpp"

#include <algorithm>

#include "particle/mps/linear/timer.hpp"
#include "particle/support/error.hpp"

namespace surge::mps {

// Eigen wants the diagonal inside the rows and the columns ascending.
void Iccg::fill(const PoissonSystem& system) {
  const auto n = static_cast<int>(system.size());
  matrix_.resize(n, n);
  matrix_.resizeNonZeros(static_cast<Eigen::Index>(system.column.size()) + n);
  int* start = matrix_.outerIndexPtr();
  int* column = matrix_.innerIndexPtr();
  double* value = matrix_.valuePtr();
#pragma omp parallel
  {
    std::vector<std::pair<int, double>> row;
#pragma omp for schedule(static)
    for (int i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      row.clear();
      row.emplace_back(i, system.diagonal[at]);
      for (int k = system.row_start[at]; k < system.row_start[at + 1]; ++k) {
        row.emplace_back(system.column[static_cast<std::size_t>(k)],
                         static_cast<double>(system.value[static_cast<std::size_t>(k)]));
      }
      std::sort(row.begin(), row.end());
      start[i] = system.row_start[at] + i;
      for (std::size_t k = 0; k < row.size(); ++k) {
        column[start[i] + static_cast<int>(k)] = row[k].first;
        value[start[i] + static_cast<int>(k)] = row[k].second;
      }
    }
  }
  start[n] = static_cast<int>(system.column.size()) + n;
}

SolveReport Iccg::solve(const PoissonSystem& system, Field& p, double tolerance,
                        int max_iterations) {
  SolveReport report;
  const auto n = static_cast<Eigen::Index>(system.size());
  Timer setup(report.setup_s);
  fill(system);
  // No shift: incomplete Cholesky of an M-matrix exists (Meijerink & van der Vorst). Eigen raises
  // the shift by itself where rounding breaks this.
  cg_.preconditioner().setInitialShift(0.0);
  cg_.compute(matrix_);
  if (cg_.info() != Eigen::Success) {
    throw Error("pressure: incomplete Cholesky failed, the equations are not positive definite");
  }
  setup.stop();

  Timer solve(report.solve_s);
  cg_.setTolerance(tolerance);
  cg_.setMaxIterations(max_iterations);
  Eigen::Map<Eigen::VectorXd> solution(p.data(), n);
  const Eigen::Map<const Eigen::VectorXd> rhs(system.rhs.data(), n);
  solution = cg_.solveWithGuess(rhs, solution).eval();
  report.iterations = static_cast<int>(cg_.iterations());
  solve.stop();
  return report;
}

}  // namespace surge::mps
