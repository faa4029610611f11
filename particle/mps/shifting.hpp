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
  return gradient<D>(
      i, neighbours, displacement, re, n0, 0.0, [](std::size_t) { return 1.0; },
      [](std::size_t) { return true; });
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

/// Root mean square of the velocities of the fluid around a particle relative to it, m/s, weighted
/// by w. A shift is no faster: what moves as a whole is not rearranged.
template <int D, class Counts>
double relative_speed(std::size_t i, std::span<const std::uint32_t> neighbours,
                      const Displacement<D>& displacement, double re, const std::array<Field, D>& v,
                      Counts&& counts) {
  double sum = 0.0;
  double weights = 0.0;
  for_each_within<D>(i, neighbours, displacement, re, counts,
                     [&](std::size_t j, const Vec<D>&, double r2) {
                       const double weight = mps_weight(std::sqrt(r2), re);
                       weights += weight;
                       for (int a = 0; a < D; ++a)
                         sum += weight * (v[a][j] - v[a][i]) * (v[a][j] - v[a][i]);
                     });
  return weights > 0.0 ? std::sqrt(sum / weights) : 0.0;
}

}  // namespace surge::mps
