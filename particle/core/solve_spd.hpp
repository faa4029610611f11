#pragma once

#include <optional>

#include "particle/core/particles.hpp"

namespace surge {

/// x of A x = b for each row b of `sides`, A symmetric and positive definite, by elimination; empty
/// where a pivot lies below `least_pivot`. Pivots are never less than the least eigenvalue.
template <std::size_t D, std::size_t N>
std::optional<std::array<std::array<double, D>, N>> solve_spd(
    std::array<std::array<double, D>, D> a, std::array<std::array<double, D>, N> sides,
    double least_pivot) {
  for (std::size_t k = 0; k < D; ++k) {
    if (a[k][k] < least_pivot) return std::nullopt;
    for (std::size_t row = k + 1; row < D; ++row) {
      const double factor = a[row][k] / a[k][k];
      for (std::size_t column = k; column < D; ++column) a[row][column] -= factor * a[k][column];
      for (auto& b : sides) b[row] -= factor * b[k];
    }
  }
  for (auto& b : sides)
    for (std::size_t k = D; k-- > 0;) {
      for (std::size_t column = k + 1; column < D; ++column) b[k] -= a[k][column] * b[column];
      b[k] /= a[k][k];
    }
  return sides;
}

/// The same for one right side.
template <std::size_t D>
std::optional<std::array<double, D>> solve_spd(const std::array<std::array<double, D>, D>& a,
                                               const std::array<double, D>& b, double least_pivot) {
  const auto x = solve_spd<D, 1>(a, {b}, least_pivot);
  if (!x) return std::nullopt;
  return (*x)[0];
}

}  // namespace surge
