#pragma once

#include "particle/core/projection.hpp"
#include "particle/mps/gradient.hpp"

namespace surge::mps {

/// Gradient of the particle concentration by the gradient model of Eq. (5), 1/m:
///   <grad C>_i = d/n0 sum_{j != i} (x_j - x_i) / |x_j - x_i|^2 w(|x_j - x_i|),
/// zero on a lattice, towards the side where the neighbours are closer, or are at all. re in m.
template <int D>
Vec<D> concentration_gradient(std::size_t i, std::span<const std::uint32_t> neighbours,
                              const Displacement<D>& displacement, double re, double n0) {
  std::array<Simd, D> sums{};
  for_each_lanes_within<D>(
      i, neighbours, displacement, re, [](std::size_t) { return true; },
      [&](const LaneIndices&, const std::array<Simd, D>& d, Simd, Simd weight) SURGE_INLINE {
        for (int a = 0; a < D; ++a) sums[a] += weight * d[a];
      });
  Vec<D> sum;
  for (int a = 0; a < D; ++a) sum[a] = D / n0 * stdx::reduce(sums[a]);
  return sum;
}

/// Particle shifting by Fick's law (Lind, Xu, Stansby & Rogers 2012, J. Comput. Phys. 231), with
/// the diffusivity that Skillen et al. (2013), Comput. Methods Appl. Mech. Eng. 265, give it, in
/// proportion to the path:
///   dx_i = -A l0 (v_max dt) <grad C>_i,
/// less the part along the normal of the surface for particles near it (Khayyer, Gotoh & Shimizu
/// 2017, J. Comput. Phys. 332, optimised particle shifting). `normal` has any length; zero means
/// that no surface is near. path: v_max dt, m.
template <int D>
Vec<D> shift(const Vec<D>& concentration_gradient, const Vec<D>& normal, double share, double l0,
             double path) {
  Vec<D> s;
  for (int a = 0; a < D; ++a) s[a] = -share * l0 * path * concentration_gradient[a];
  return without_part_along(s, normal);
}

/// What a shift asks of the neighbours, by one pass over them.
template <int D>
struct Surroundings {
  Vec<D> concentration_gradient;  ///< of all, 1/m
  /// Of the fluid, see velocity_gradient(): empty where it can't be trusted.
  std::optional<std::array<Vec<D>, D>> velocity_gradient;
  /// Root mean square of the velocities of the fluid around relative to the particle, weighted by
  /// w, m/s. A shift is no faster: what moves as a whole is not rearranged.
  double relative_speed;
};

/// v: m/s; counts(j): whether j is of the fluid. re in m.
template <int D, class Counts>
Surroundings<D> surroundings(std::size_t i, std::span<const std::uint32_t> neighbours,
                             const Displacement<D>& displacement, double re, double n0,
                             double limit, const std::array<Field, D>& v, Counts&& counts) {
  std::array<Simd, D> concentration{};
  std::array<Simd, D*(D + 1) / 2> moments{};
  std::array<std::array<Simd, D>, D> sums{};
  Simd squares = 0.0;
  Simd weights = 0.0;
  for_each_lanes_within<D>(
      i, neighbours, displacement, re, [](std::size_t) { return true; },
      [&](const LaneIndices& j, const std::array<Simd, D>& d, Simd r2, Simd weight) SURGE_INLINE {
        for (int a = 0; a < D; ++a) concentration[a] += weight * d[a];
        weight *= lanes_of(j, [&](std::size_t k) { return counts(k) ? 1.0 : 0.0; });
        add_moments<D>(weight, d, moments);
        weights += weight * r2;
        Simd square = 0.0;
        for (int a = 0; a < D; ++a) {
          const Simd relative = pick(v[a], j) - v[a][i];
          square += relative * relative;
          for (int b = 0; b < D; ++b) sums[a][b] += weight * relative * d[b];
        }
        squares += weight * r2 * square;
      });
  Surroundings<D> found;
  std::array<Vec<D>, D> rows;
  for (int a = 0; a < D; ++a) {
    found.concentration_gradient[a] = D / n0 * stdx::reduce(concentration[a]);
    for (int b = 0; b < D; ++b) rows[a][b] = stdx::reduce(sums[a][b]);
  }
  found.velocity_gradient = solve_spd(symmetric<D>(moments), rows, limit * n0 / D);
  const double all = stdx::reduce(weights);
  found.relative_speed = all > 0.0 ? std::sqrt(stdx::reduce(squares) / all) : 0.0;
  return found;
}

}  // namespace surge::mps
