#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "particle/core/neighbour_list.hpp"
#include "particle/core/simd.hpp"

namespace surge {

// GCC 12 takes its own placeholder for an uninitialised value, as in root().
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
/// Rounded to the digits of a float. By the library's casts: of lanes that are cast one by one, GCC
/// 12 leaves the rounding out.
inline Simd in_single_precision(Simd x) {
  using Narrow = stdx::rebind_simd_t<float, Simd>;
  return stdx::static_simd_cast<Simd>(stdx::static_simd_cast<Narrow>(x));
}
#pragma GCC diagnostic pop

/// As many particles as the processor works on at once.
using LaneIndices = std::array<std::uint32_t, simd_width>;

/// f(j) of each of them.
template <class F>
SURGE_INLINE inline Simd lanes_of(const LaneIndices& j, F&& f) {
  return Simd([&](auto lane) { return static_cast<double>(f(std::size_t{j[lane]})); });
}

/// from[j] of each of them.
SURGE_INLINE inline Simd pick(const Field& from, const LaneIndices& j) {
  const double* values = from.data();
  return Simd([&](auto lane) { return values[j[lane]]; });
}

/// x_j - x_i of whole vectors of j, m.
template <int D>
SURGE_INLINE inline std::array<Simd, D> displacements(const Displacement<D>& displacement,
                                                      std::size_t i, const LaneIndices& j) {
  std::array<Simd, D> d;
  for (int a = 0; a < D; ++a) {
    const double* x = displacement.positions(a);
    d[a] = Simd([&](auto lane) { return x[j[lane]]; }) - x[i];
  }
  if (displacement.is_periodic())
    for (int a = 0; a < D; ++a)
      d[a] -= displacement.length(a) * stdx::nearbyint(d[a] * displacement.inverse_length(a));
  return d;
}

/// Calls f(j, x_j - x_i, |x_j - x_i|^2) for whole vectors of the neighbours of i, in the order of
/// the list. Lanes that are left over are i itself, at the distance zero.
template <int D, class F>
SURGE_INLINE inline void for_each_lanes(std::size_t i, std::span<const std::uint32_t> neighbours,
                                        const Displacement<D>& displacement, F&& f) {
  LaneIndices j;
  for (std::size_t k = 0; k < neighbours.size(); k += simd_width) {
    if (k + simd_width <= neighbours.size()) {
      std::copy_n(neighbours.data() + k, simd_width, j.data());
    } else {
      j.fill(static_cast<std::uint32_t>(i));
      std::copy(neighbours.begin() + static_cast<std::ptrdiff_t>(k), neighbours.end(), j.begin());
    }
    const std::array<Simd, D> d = displacements<D>(displacement, i, j);
    Simd r2 = d[0] * d[0];
    for (int a = 1; a < D; ++a) r2 += d[a] * d[a];
    f(j, d, r2);
  }
}

}  // namespace surge
