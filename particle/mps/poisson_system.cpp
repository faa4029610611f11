#include "particle/mps/poisson_system.hpp"

#include <cmath>

namespace surge::mps {

void multiply(const PoissonSystem& system, const Field& x, Field& y) {
  const auto n = static_cast<std::int32_t>(system.size());
  y.resize(system.size());
  const std::int32_t* start = system.row_start.data();
  const std::int32_t* column = system.column.data();
  const double* value = system.value.data();
#pragma omp parallel for schedule(static)
  for (std::int32_t i = 0; i < n; ++i) {
    double sum = system.diagonal[static_cast<std::size_t>(i)] * x[static_cast<std::size_t>(i)];
    for (std::int32_t k = start[i]; k < start[i + 1]; ++k) {
      sum += value[k] * x[static_cast<std::size_t>(column[k])];
    }
    y[static_cast<std::size_t>(i)] = sum;
  }
}

void compute_excess(const PoissonSystem& system, Field& excess) {
  // Weights are summed in any order; a single p = 0 neighbour weighs far more than this.
  constexpr double rounding = 1e-11;
  const auto n = static_cast<std::int32_t>(system.size());
  excess.resize(system.size());
#pragma omp parallel for schedule(static)
  for (std::int32_t i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    double sum = system.diagonal[at];
    const auto end = static_cast<std::size_t>(system.row_start[at + 1]);
    for (auto k = static_cast<std::size_t>(system.row_start[at]); k < end; ++k) {
      sum += system.value[k];
    }
    excess[at] = sum > rounding * system.diagonal[at] ? sum : 0.0;
  }
}

double relative_residual(const PoissonSystem& system, const Field& p) {
  Field product;
  multiply(system, p, product);
  double residual = 0.0;
  double rhs = 0.0;
  for (std::size_t i = 0; i < system.size(); ++i) {
    const double r = system.rhs[i] - product[i];
    residual += r * r;
    rhs += system.rhs[i] * system.rhs[i];
  }
  return std::sqrt(rhs > 0.0 ? residual / rhs : residual);
}

}  // namespace surge::mps
