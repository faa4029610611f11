#pragma once

#include <algorithm>

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
  std::array<Simd, D> sums{};
  for_each_lanes<D>(i, neighbours, displacement,
                    [&](const LaneIndices&, const std::array<Simd, D>& d, Simd r2) SURGE_INLINE {
                      const Simd weight = mps_weights(r2, re);
                      for (int a = 0; a < D; ++a) sums[a] += weight * d[a];
                    });
  Vec<D> sum;
  for (int a = 0; a < D; ++a) sum[a] = stdx::reduce(sums[a]);
  return std::sqrt(squared_norm<D>(sum)) / (n0 * l0);
}

/// Below this share of n0 a particle is on the surface whatever its offset is: sheets of one and
/// two layers of the lattice have 0.35 n0 and 0.67 n0, and their neighbours may lie on both sides.
inline constexpr double thin_sheet = 0.8;

/// How thick the layer of water is that a surface particle stands for, m:
///   l0 [1 + (d - 1) (n_s - n_l) / sum_l re/r],
/// n_s being the number density of the surface particles around it, n_l that of one layer of the
/// lattice, and the sum over this layer too: to first order, particles that have come nearer along
/// the surface by a share e make it thicker by (d - 1) e. Water under the crest of a wave is
/// pressed together along the surface and stretched across it; with the thickness of the start its
/// pressure would be too low by k l0/2 of the head of the wave, and the period too long. No more
/// than twice and no less than half of l0.
template <int D>
class LayerThickness {
 public:
  /// re and l0 in m
  LayerThickness(double re, double l0)
      : re_(re),
        l0_(l0),
        density_(lattice_sum<D - 1>(re / l0, [&](double r) { return mps_weight(r * l0, re); })),
        slope_(lattice_sum<D - 1>(re / l0, [&](double r) { return re / (r * l0); }) / (D - 1)) {}

  /// Number density in the top layer of the lattice under a flat surface, n0 being that inside.
  [[nodiscard]] double flat_density(double n0) const { return 0.5 * (n0 + density_); }

  /// on_surface(j): whether j is a surface particle of the fluid
  template <class OnSurface>
  double operator()(std::size_t i, std::span<const std::uint32_t> neighbours,
                    const Displacement<D>& displacement, OnSurface&& on_surface) const {
    double n = 0.0;
    for_each_within<D>(
        i, neighbours, displacement, re_, on_surface,
        [&](std::size_t, const Vec<D>&, double r2) { n += mps_weight(std::sqrt(r2), re_); });
    return l0_ * std::clamp(1.0 + (n - density_) / slope_, 0.5, 2.0);
  }

 private:
  double re_;
  double l0_;
  double density_;
  double slope_;
};

}  // namespace surge::mps
