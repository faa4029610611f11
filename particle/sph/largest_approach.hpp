#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/core/extremes.hpp"
#include "particle/core/particles.hpp"

namespace surge::sph {

/// Bound on how much nearer (m) any two particles have come since they were at `then`: their
/// displacements d differ by no more than the box that holds all of them is long,
///   |d_i - d_j|^2 <= sum_a (max d_a - min d_a)^2.
/// Particles that move together do not approach, which twice the longest path would not know.
/// Infinite where a position is not finite.
template <int D>
double largest_approach(const std::array<Field, D>& now, const std::array<Field, D>& then) {
  const auto n = static_cast<std::ptrdiff_t>(now[0].size());
  double square = 0.0;
  for (int a = 0; a < D; ++a) {
    const auto [least, most, finite] =
        extremes_of(n, [&](std::ptrdiff_t i) { return now[a][i] - then[a][i]; });
    if (!finite) return std::numeric_limits<double>::infinity();
    square += (most - least) * (most - least);
  }
  return std::sqrt(square);
}

}  // namespace surge::sph
