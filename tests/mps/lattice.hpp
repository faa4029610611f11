#pragma once

#include <array>
#include <cstddef>

#include "particle/core/cell_grid.hpp"
#include "particle/core/neighbour_list.hpp"

namespace surge::mps::testing {

inline constexpr double l0 = 0.005;

/// A square (cubic) lattice of odd width with its middle particle, neighbours found by cells.
template <int D>
struct Lattice {
  explicit Lattice(int half, double radius) {
    const int width = 2 * half + 1;
    int n = 1;
    for (int a = 0; a < D; ++a) n *= width;
    for (int k = 0; k < n; ++k) {
      int rest = k;
      for (int a = 0; a < D; ++a) {
        x[a].push_back((rest % width - half) * l0);
        rest /= width;
      }
    }
    CellGrid<D> grid(Search::cell_grid, {});
    grid.build(x, radius, 2);
    for (int a = 0; a < D; ++a) grid.reorder(x[a]);
    list.build(grid, x, radius, [](std::size_t) { return true; });
    for (std::size_t i = 0; i < x[0].size(); ++i) {
      double r2 = 0.0;
      for (int a = 0; a < D; ++a) r2 += x[a][i] * x[a][i];
      if (r2 < 1e-12) middle = i;
    }
  }
  std::array<Field, D> x;
  NeighbourList<D> list;
  std::size_t middle = 0;
};

/// The lattice with every particle moved by up to 0.2 l0, the same way in each run.
template <int D>
Lattice<D> jittered(double radius) {
  Lattice<D> lattice(5, radius);
  unsigned state = 12345;
  for (int a = 0; a < D; ++a)
    for (double& x : lattice.x[a]) {
      state = state * 1664525u + 1013904223u;
      x += (static_cast<double>(state >> 8) / (1u << 24) - 0.5) * 0.4 * l0;
    }
  return lattice;
}

inline constexpr auto everyone = [](std::size_t) { return true; };

}  // namespace surge::mps::testing
