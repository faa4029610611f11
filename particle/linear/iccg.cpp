#include "particle/linear/iccg.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "particle/support/error.hpp"

namespace surge::linear {

// Eigen wants columns with ascending rows, here those of the lower triangle. The matrix is
// symmetric: column j of it is the part of row j from the diagonal on.
void Iccg::factorise(const PoissonSystem& system) {
  const auto n = static_cast<int>(system.size());
  const auto each_in_column = [&](int j, const auto& f) {
    const auto at = static_cast<std::size_t>(j);
    for (int k = system.row_start[at]; k < system.row_start[at + 1]; ++k)
      if (system.column[static_cast<std::size_t>(k)] > j) f(static_cast<std::size_t>(k));
  };
  lower_.resize(n, n);
  int* start = lower_.outerIndexPtr();
  start[0] = 0;
  for (int j = 0; j < n; ++j) {
    int entries = 1;
    each_in_column(j, [&](std::size_t) { ++entries; });
    start[j + 1] = start[j] + entries;
  }
  lower_.resizeNonZeros(start[n]);
  int* row = lower_.innerIndexPtr();
  float* value = lower_.valuePtr();
#pragma omp parallel
  {
    std::vector<std::pair<int, float>> column;
#pragma omp for schedule(static)
    for (int j = 0; j < n; ++j) {
      column.clear();
      column.emplace_back(j, static_cast<float>(system.diagonal[static_cast<std::size_t>(j)]));
      each_in_column(
          j, [&](std::size_t k) { column.emplace_back(system.column[k], system.value[k]); });
      std::sort(column.begin(), column.end());
      for (std::size_t k = 0; k < column.size(); ++k) {
        row[start[j] + static_cast<int>(k)] = column[k].first;
        value[start[j] + static_cast<int>(k)] = column[k].second;
      }
    }
  }
  // No shift: incomplete Cholesky of an M-matrix exists (Meijerink & van der Vorst). Eigen raises
  // the shift by itself where rounding breaks this.
  factor_.setInitialShift(0.0);
  factor_.compute(lower_);
  if (factor_.info() != Eigen::Success) {
    throw Error("pressure: incomplete Cholesky failed, the equations are not positive definite");
  }
}

double Iccg::apply(const Field& r, Field& z) {
  const auto n = static_cast<Eigen::Index>(r.size());
  single_r_ = Eigen::Map<const Eigen::VectorXd>(r.data(), n).cast<float>();
  single_z_ = factor_.solve(single_r_);
  Eigen::Map<Eigen::VectorXd>(z.data(), n) = single_z_.cast<double>();
  return dot(r, z, block_sum_);
}

SolveReport Iccg::solve(const PoissonSystem& system, Field& p, double tolerance,
                        int max_iterations) {
  return cg_(
      system, p, tolerance, max_iterations, [&] { factorise(system); },
      [&](const Field& r, Field& z) { return apply(r, z); });
}

}  // namespace surge::linear
