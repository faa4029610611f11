#pragma once

#include "particle/mps/number_density.hpp"

namespace surge::mps {

// Eq. (14)
/// A particle is on the free surface, and gets p = 0, where its number density n* < beta n0.
inline bool on_free_surface(double n, double beta, double n0) {
  return n < beta * n0;
}

/// Length of sum_{j != i} w (x_j - x_i) over n0 l0: by how much the neighbours lie to one side.
/// Zero inside, 0.33 (0.44) in the top layer of the square lattice and 0.02 (0.17) in the second
/// with re = 2.1 l0 (3.1 l0). re and l0 in m.
template <int D>
double neighbour_offset(std::size_t i, std::span<const std::uint32_t> neighbours,
                        const Displacement<D>& displacement, double re, double n0, double l0) {
  Vec<D> sum{};
  for (const std::uint32_t j : neighbours) {
    const Vec<D> d = displacement(i, j);
    const double weight = mps_weight(std::sqrt(squared_norm<D>(d)), re);
    for (int a = 0; a < D; ++a) sum[a] += weight * d[a];
  }
  return std::sqrt(squared_norm<D>(sum)) / (n0 * l0);
}

/// Below this share of n0 a particle is on the surface whatever its offset is: sheets of one and
/// two layers of the lattice have 0.35 n0 and 0.67 n0, and their neighbours may lie on both sides.
inline constexpr double thin_sheet = 0.8;

}  // namespace surge::mps
