#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "particle/core/particles.hpp"

namespace surge::mps {

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Numbers the points of a box of a square (cubic) grid that are in use. A wrapped axis is
/// periodic.
template <int D>
class GridIndex {
 public:
  using Coordinate = std::array<std::int32_t, D>;

  /// `extent` points along each axis.
  void reset(const Coordinate& extent, const std::array<bool, D>& wrapped);
  /// The number of a point, a new one where it has none yet.
  std::int32_t add(Coordinate c);
  /// The number of a point, or -1: not in use, or outside.
  [[nodiscard]] std::int32_t find(Coordinate c) const;

  [[nodiscard]] const std::vector<Coordinate>& points() const { return points_; }
  [[nodiscard]] const Coordinate& extent() const { return extent_; }
  [[nodiscard]] const std::array<bool, D>& wrapped() const { return wrapped_; }

 private:
  [[nodiscard]] bool wrap(Coordinate& c) const;
  [[nodiscard]] std::size_t offset(const Coordinate& c) const;

  Coordinate extent_{};
  std::array<bool, D> wrapped_{};
  std::vector<std::int32_t> number_;
  std::vector<Coordinate> points_;
};

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

/// A V-cycle on a hierarchy of nested grids with linear interpolation, Galerkin operators and one
/// coloured Gauss-Seidel sweep before and, in reverse, after: a symmetric positive definite
/// operation. Results do not depend on the number of threads.
/// W. L. Briggs, V. E. Henson & S. F. McCormick, A Multigrid Tutorial, 2nd ed., SIAM, 2000.
template <int D>
class GridMultigrid {
 public:
  /// The finest level, to be filled before build().
  GridLevel<D>& finest() { return levels_.front(); }
  void build();
  /// finest().solution becomes an approximation of the inverse times finest().rhs.
  void cycle();
  [[nodiscard]] int levels() const { return count_; }

 private:
  static bool coarsen(GridLevel<D>& fine, GridLevel<D>& coarse);
  static void galerkin(const GridLevel<D>& fine, GridLevel<D>& coarse);
  void factorise_coarsest();
  void solve_coarsest();

  std::vector<GridLevel<D>> levels_ = std::vector<GridLevel<D>>(1);
  int count_ = 1;
  Field factor_;  // dense Cholesky factor of the coarsest level, row by row
};

}  // namespace surge::mps
