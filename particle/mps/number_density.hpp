#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "particle/core/neighbour_lanes.hpp"
#include "particle/core/neighbour_list.hpp"
#include "particle/kernel/mps_weight.hpp"

namespace surge::mps {

/// mps_weight() of whole vectors of squared distances, m^2; zero for a particle and itself.
SURGE_INLINE inline Simd mps_weights(Simd r2, double re) {
  const Simd r = root(r2);
  Simd weight = re / r - 1.0;
  stdx::where(r >= re || r2 == 0.0, weight) = 0.0;
  return weight;
}

// Eq. (4)
/// Particle number density <n>_i = sum_{j != i} w(|x_j - x_i|), dimensionless; re in m.
template <int D>
double number_density(std::size_t i, std::span<const std::uint32_t> neighbours,
                      const Displacement<D>& displacement, double re) {
  Simd n = 0.0;
  for_each_lanes<D>(i, neighbours, displacement,
                    [&](const LaneIndices&, const std::array<Simd, D>&, Simd r2)
                        SURGE_INLINE { n += mps_weights(r2, re); });
  return stdx::reduce(n);
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

/// The same for whole vectors of neighbours: f(j, x_j - x_i, r^2, w/r^2), the last being zero in
/// lanes that do not count. The sums differ from those one by one by rounding.
template <int D, class Counts, class F>
SURGE_INLINE inline void for_each_lanes_within(std::size_t i,
                                               std::span<const std::uint32_t> neighbours,
                                               const Displacement<D>& displacement, double re,
                                               Counts&& counts, F&& f) {
  for_each_lanes<D>(i, neighbours, displacement,
                    [&](const LaneIndices& j, const std::array<Simd, D>& d, Simd r2) SURGE_INLINE {
                      const Simd r = root(r2);
                      const Simd inverse = 1.0 / r;
                      Simd weight = (re * inverse - 1.0) * inverse * inverse;
                      stdx::where(r >= re || r2 == 0.0, weight) = 0.0;
                      stdx::where(lanes_of(j, counts) == 0.0, weight) = 0.0;
                      f(j, d, r2, weight);
                    });
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
