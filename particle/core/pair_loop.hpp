#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <omp.h>

#include "particle/core/cell_grid.hpp"
#include "particle/core/parallel_for.hpp"
#include "particle/core/simd.hpp"

namespace surge {

/// Candidates for being neighbours of the particles of one cell: F fields side by side, positions
/// first, padded to whole vectors with particles so far away that every kernel is zero there.
template <int F>
struct Tile {
  std::array<const double*, F> field;
  std::size_t count;  ///< a multiple of simd_width
};

/// Gathers tiles. One per thread and solver; its memory is kept from step to step.
template <int D, int F>
class TileBuffer {
 public:
  Tile<F> gather(const CellGrid<D>& grid, std::size_t cell,
                 const std::array<const double*, F>& fields) {
    std::size_t count = 0;
    segments_.clear();
    grid.for_each_segment(cell, [&](const auto& s) {
      segments_.push_back(s);
      count += s.end - s.begin;
    });
    const std::size_t padded = (count + simd_width - 1) / simd_width * simd_width;
    if (padded > capacity_) {
      // An odd number of cache lines between the fields keeps them out of each other's cache sets.
      capacity_ = (padded * 3 / 2 + 7) / 8 * 8 | 8;
      data_.resize(capacity_ * F);
    }
    Tile<F> tile;
    tile.count = padded;
    for (int k = 0; k < F; ++k) {
      double* out = data_.data() + static_cast<std::size_t>(k) * capacity_;
      tile.field[k] = out;
      for (const auto& s : segments_) {
        copy_run(fields[k] + s.begin, s.end - s.begin, k < D ? s.shift[k] : 0.0, out);
        out += s.end - s.begin;
      }
      for (std::size_t j = count; j < padded; ++j) *out++ = k < D ? far_away : 0.0;
    }
    return tile;
  }

 private:
  static constexpr double far_away = 1e15;
  Field data_;
  std::size_t capacity_ = 0;
  std::vector<typename CellGrid<D>::Segment> segments_;
};

/// Calls body(i, tile, thread) for every particle i of the cells for which wanted(cell) holds; the
/// tile has all particles closer to i than the radius of the grid, i itself among them. Each i is
/// visited by one thread and its tile has the same order whatever their number.
template <int D, int F, class Wanted, class Body>
void pair_loop(const CellGrid<D>& grid, std::vector<TileBuffer<D, F>>& buffers,
               const std::array<const double*, F>& fields, Wanted&& wanted, Body&& body) {
  buffers.resize(std::max(buffers.size(), static_cast<std::size_t>(omp_get_max_threads())));
  const auto cells = static_cast<std::ptrdiff_t>(grid.cell_count());
  if (grid.single_cell()) {
    const Tile<F> tile = buffers.front().gather(grid, 0, fields);
    const auto n = static_cast<std::ptrdiff_t>(grid.particles_of(0).second);
    parallel_for_in_turn(n, 64, [&](std::ptrdiff_t i, std::size_t thread) {
      body(static_cast<std::size_t>(i), tile, thread);
    });
    return;
  }
  parallel_for_in_turn(cells, 64, [&](std::ptrdiff_t c, std::size_t thread) {
    const auto cell = static_cast<std::size_t>(c);
    const auto [begin, end] = grid.particles_of(cell);
    if (begin == end || !wanted(cell)) return;
    const Tile<F> tile = buffers[thread].gather(grid, cell, fields);
    for (std::size_t i = begin; i < end; ++i) body(i, tile, thread);
  });
}

}  // namespace surge
