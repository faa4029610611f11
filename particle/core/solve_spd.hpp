#pragma once

#include <optional>

#include "particle/core/particles.hpp"

namespace surge {

/// x of A x = b for a symmetric positive definite A by elimination; empty where a pivot lies
/// below `least_pivot`. Pivots are never less than the least eigenvalue.
template <std::size_t D>
std::optional<std::array<double, D>> solve_spd(std::array<std::array<double, D>, D> a,
                                               std::array<double, D> b, double least_pivot) {
  for (std::size_t k = 0; k < D; ++k) {
    if (a[k][k] < least_pivot) return std::nullopt;
    for (std::size_t row = k + 1; row < D; ++row) {
      const double factor = a[row][k] / a[k][k];
      for (std::size_t column = k; column < D; ++column) a[row][column] -= factor * a[k][column];
      b[row] -= factor * b[k];
    }
  }
  for (std::size_t k = D; k-- > 0;) {
    for (std::size_t column = k + 1; column < D; ++column) b[k] -= a[k][column] * b[column];
    b[k] /= a[k][k];
  }
  return b;
}

}  // namespace surge
