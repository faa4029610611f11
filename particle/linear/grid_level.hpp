#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "particle/core/particles.hpp"
#include "particle/linear/grid_index.hpp"

namespace surge::linear {

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// One level of the multigrid: a symmetric operator that couples each node with its 3^D - 1
/// nearest. Single precision serves, because all of this only preconditions.
template <int D>
struct GridLevel {
  static constexpr int stencil = power(3, D);  ///< entry s: offset (s / 3^a) % 3 - 1 along axis a
  static constexpr int corners = power(2, D);  ///< corner q: (q >> a) & 1 along axis a

  GridIndex<D> index;
  AlignedVector<std::int32_t> neighbour;  ///< [node][stencil]; the node itself where there is none
  AlignedVector<float> value;             ///< [node][stencil]; 0 at the centre
  AlignedVector<float> diagonal;
  AlignedVector<float> inverse_diagonal;  ///< 0 where the diagonal is
  AlignedVector<float> rhs;
  AlignedVector<float> solution;
  AlignedVector<float> residual;
  /// Nodes with the same parity of their coordinates: they do not couple with each other.
  std::array<std::vector<std::int32_t>, corners> colour;

  std::array<bool, D> halved{};        ///< the axes that the next level coarsens
  AlignedVector<std::int32_t> parent;  ///< [node][corners] on the next level
  AlignedVector<float> parent_weight;  ///< [node][corners]
  AlignedVector<std::int32_t> child;   ///< [node][stencil] on the level before, or -1

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(diagonal.size()); }
  /// Sizes everything for the nodes in `index` and sets the operator to zero.
  void allocate();
  /// To be called when value and diagonal are complete.
  void finish();
};

}  // namespace surge::linear
