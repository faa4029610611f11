#include "particle/linear/poisson_system.hpp"

#include <cmath>

#include "particle/core/parallel_for.hpp"
#include "particle/linear/block_sum.hpp"

namespace surge::linear {

void multiply(const PoissonSystem& system, const Field& x, Field& y) {
  const auto n = static_cast<std::int32_t>(system.size());
  y.resize(system.size());
  parallel_for(n, 512, [&](std::int32_t i) {
    const auto at = static_cast<std::size_t>(i);
    y[at] = row_product(system, x, at);
  });
}

void compute_excess(const PoissonSystem& system, Field& excess) {
  // Weights are summed in any order; a single p = 0 neighbour weighs far more than this.
  constexpr double rounding = 1e-11;
  const auto n = static_cast<std::int32_t>(system.size());
  excess.resize(system.size());
  parallel_for(n, 512, [&](std::int32_t i) {
    const auto at = static_cast<std::size_t>(i);
    double sum = system.diagonal[at];
    const auto end = static_cast<std::size_t>(system.row_start[at + 1]);
    for (auto k = static_cast<std::size_t>(system.row_start[at]); k < end; ++k) {
      sum += static_cast<double>(system.value[k]);
    }
    excess[at] = sum > rounding * system.diagonal[at] ? sum : 0.0;
  });
}

double relative_residual(const PoissonSystem& system, const Field& p, BlockSum& block_sum) {
  const double residual = block_sum(system.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double r = system.rhs[i] - row_product(system, p, i);
      sum += r * r;
    }
    return sum;
  });
  const double rhs = dot(system.rhs, system.rhs, block_sum);
  return std::sqrt(rhs > 0.0 ? residual / rhs : residual);
}

}  // namespace surge::linear
