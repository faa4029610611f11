#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "particle/core/neighbour_list.hpp"
#include "particle/kernel/mps_weight.hpp"

namespace surge::mps {

// Eq. (4)
/// Particle number density <n>_i = sum_{j != i} w(|x_j - x_i|), dimensionless; re in m.
template <int D>
double number_density(std::size_t i, std::span<const std::uint32_t> neighbours,
                      const Displacement<D>& displacement, double re) {
  double n = 0.0;
  for (const std::uint32_t j : neighbours)
    n += mps_weight(std::sqrt(squared_norm<D>(displacement(i, j))), re);
  return n;
}

/// Calls f(j, x_j - x_i, r^2) for the neighbours within re (m) that `counts` lets in: what the
/// models of gradient and divergence sum over.
template <int D, class Counts, class F>
void for_each_within(std::size_t i, std::span<const std::uint32_t> neighbours,
                     const Displacement<D>& displacement, double re, Counts&& counts, F&& f) {
  for (const std::uint32_t j : neighbours) {
    if (!counts(j)) continue;
    const Vec<D> d = displacement(i, j);
    const double r2 = squared_norm<D>(d);
    if (r2 >= re * re || r2 == 0.0) continue;
    f(j, d, r2);
  }
}

/// Sum of f(r) over the points of the infinite square (cubic) lattice of unit spacing with
/// 0 < r < re, re in units of the spacing.
template <int D, class F>
double lattice_sum(double re, F&& f) {
  const int reach = static_cast<int>(std::ceil(re));
  const int width = 2 * reach + 1;
  int points = 1;
  for (int a = 0; a < D; ++a) points *= width;
  double sum = 0.0;
  for (int k = 0; k < points; ++k) {
    int rest = k;
    double r2 = 0.0;
    for (int a = 0; a < D; ++a) {
      const double x = rest % width - reach;
      rest /= width;
      r2 += x * x;
    }
    if (r2 > 0.0 && r2 < re * re) sum += f(std::sqrt(r2));
  }
  return sum;
}

/// The constant value n0 of Eqs. (9) and (12): the number density inside the initial lattice.
/// re in units of l0.
template <int D>
double reference_number_density(double re) {
  return lattice_sum<D>(re, [re](double r) { return mps_weight(r, re); });
}

}  // namespace surge::mps
