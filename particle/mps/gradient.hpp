#pragma once

#include <algorithm>
#include <optional>

#include "particle/core/solve_spd.hpp"
#include "particle/mps/number_density.hpp"

namespace surge::mps {

/// Adds weight d d^T to a symmetric matrix, row by row from the diagonal on.
template <int D>
SURGE_INLINE inline void add_moments(Simd weight, const std::array<Simd, D>& d,
                                     std::array<Simd, D*(D + 1) / 2>& moments) {
  std::size_t k = 0;
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b) moments[k++] += weight * d[a] * d[b];
}
/// The matrix of the sums over lanes.
template <int D>
std::array<Vec<D>, D> symmetric(const std::array<Simd, D*(D + 1) / 2>& moments) {
  std::array<Vec<D>, D> matrix;
  std::size_t k = 0;
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b) matrix[a][b] = matrix[b][a] = stdx::reduce(moments[k++]);
  return matrix;
}

// Eq. (6)
/// The least value of phi among i and those of its neighbours within re (m) that `counts` lets in
/// (Koshizuka, Nobe & Oka 1998). w(0) does not vanish, so i itself is one of them.
template <int D, class Phi, class Counts>
double neighbourhood_minimum(std::size_t i, std::span<const std::uint32_t> neighbours,
                             const Displacement<D>& displacement, double re, Phi&& phi,
                             Counts&& counts) {
  double least = phi(i);
  for (const std::uint32_t j : neighbours)
    if (counts(j) && squared_norm<D>(displacement(i, j)) < re * re) least = std::min(least, phi(j));
  return least;
}

// Eq. (5)
/// Gradient model (Koshizuka & Oka 1996) with a reference value phi'_i in place of phi_i:
///   <grad phi>_i = d/n0 sum_{j != i} (phi_j - phi'_i) / |x_j - x_i|^2 (x_j - x_i) w(|x_j - x_i|).
/// re in m; the result has the unit of phi per m.
template <int D, class Phi, class Counts>
Vec<D> gradient(std::size_t i, std::span<const std::uint32_t> neighbours,
                const Displacement<D>& displacement, double re, double n0, double reference,
                Phi&& phi, Counts&& counts) {
  Vec<D> sum{};
  for_each_within<D>(
      i, neighbours, displacement, re, counts, [&](std::size_t j, const Vec<D>& d, double r2) {
        const double factor = (phi(j) - reference) / r2 * mps_weight(std::sqrt(r2), re);
        for (int a = 0; a < D; ++a) sum[a] += factor * d[a];
      });
  for (double& component : sum) component *= D / n0;
  return sum;
}

/// Gradient model that conserves momentum (Khayyer & Gotoh 2008, Coast. Eng. J. 50, CMPS): the same
/// sum over (phi_j + phi_i) - (least_j + least_i), least being the neighbourhood's minimum. What i
/// gets from j is the opposite of what j gets from i, and never pulls the two together.
template <int D, class Phi, class Least, class Counts>
Vec<D> conserving_gradient(std::size_t i, std::span<const std::uint32_t> neighbours,
                           const Displacement<D>& displacement, double re, double n0, Phi&& phi,
                           Least&& least, Counts&& counts) {
  const double own = phi(i) - least(i);
  // (phi_j - reference) with the reference that makes the sum above out of it
  return gradient<D>(
      i, neighbours, displacement, re, n0, -own, [&](std::size_t j) { return phi(j) - least(j); },
      counts);
}

/// First-order consistent gradient (Khayyer & Gotoh 2011, J. Comput. Phys. 230):
///   C_i sum (phi_j - phi_i) (x_j - x_i) / r^2 w,  C_i = [ sum (x_j - x_i)(x_j - x_i)^T / r^2 w
///   ]^-1,
/// exact for linear fields wherever the neighbours are. Empty where they are too few, or nearly in
/// a line, for C to be trusted: a pivot of the matrix below `limit` times n0/d, which it is on the
/// full lattice.
template <int D, class Phi, class Counts>
std::optional<Vec<D>> corrected_gradient(std::size_t i, std::span<const std::uint32_t> neighbours,
                                         const Displacement<D>& displacement, double re, double n0,
                                         double limit, Phi&& phi, Counts&& counts) {
  std::array<Simd, D*(D + 1) / 2> moments{};
  std::array<Simd, D> sums{};
  const double own = phi(i);
  for_each_lanes_within<D>(
      i, neighbours, displacement, re, counts,
      [&](const LaneIndices& j, const std::array<Simd, D>& d, Simd, Simd weight) SURGE_INLINE {
        const Simd change = weight * (lanes_of(j, phi) - own);
        for (int a = 0; a < D; ++a) sums[a] += change * d[a];
        add_moments<D>(weight, d, moments);
      });
  const auto moment = symmetric<D>(moments);
  Vec<D> sum;
  for (int a = 0; a < D; ++a) sum[a] = stdx::reduce(sums[a]);
  return solve_spd(moment, sum, limit * n0 / D);
}

}  // namespace surge::mps
