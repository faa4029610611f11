#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/parallel_for.hpp"
#include "particle/core/particles.hpp"
#include "particle/core/search.hpp"

namespace surge {

/// Extent of the periodic axes; an axis that is not periodic has length 0.
template <int D>
struct Periodicity {
  Vec<D> lower{};
  Vec<D> length{};
};

template <int D>
Periodicity<D> periodicity_of(const Case& c);

/// Sorts particles into square cells, x running fastest, so that everything within a radius of a
/// particle lies in a few contiguous stretches of memory. With Search::all_pairs there is a single
/// cell and the order is left alone: every particle meets every other one, as in the paper.
///
/// Use: build() computes the order, reorder() applies it to each field.
template <int D>
class CellGrid {
 public:
  /// A stretch [begin, end) of sorted particles and what to add to their positions (periodic
  /// image).
  struct Segment {
    std::size_t begin;
    std::size_t end;
    Vec<D> shift;
  };

  CellGrid(Search search, const Periodicity<D>& periodicity)
      : search_(search), periodicity_(periodicity) {}

  /// Finds the cell order of the positions x so that every neighbour closer than `radius` is in one
  /// of the cells at most `reach` away. Positions on periodic axes are wrapped into the period.
  /// Throws Error where a position is not finite.
  void build(std::array<Field, D>& x, double radius, int reach);

  template <class T>
  void reorder(AlignedVector<T>& field) {
    if (search_ == Search::all_pairs) return;
    auto& scratch = scratch_for<T>();
    scratch.resize(field.size());
    const auto n = static_cast<std::ptrdiff_t>(field.size());
    parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) { scratch[i] = field[order_[i]]; });
    field.swap(scratch);
  }
  /// Applies the order to all fields of the particles.
  void reorder(Particles<D>& p) {
    for (int a = 0; a < D; ++a) {
      reorder(p.x[a]);
      reorder(p.v[a]);
    }
    reorder(p.pressure);
    reorder(p.density);
    reorder(p.type);
    reorder(p.id);
  }

  [[nodiscard]] bool single_cell() const { return search_ == Search::all_pairs; }
  [[nodiscard]] std::size_t cell_count() const { return cell_begin_.size() - 1; }
  [[nodiscard]] std::size_t particle_count() const { return cell_begin_.back(); }
  [[nodiscard]] std::pair<std::size_t, std::size_t> particles_of(std::size_t cell) const {
    return {cell_begin_[cell], cell_begin_[cell + 1]};
  }

  /// Cells along each axis, x running fastest in the numbering of cells.
  [[nodiscard]] const std::array<int, D>& cells() const { return cells_; }
  [[nodiscard]] int reach() const { return reach_; }
  [[nodiscard]] bool is_periodic(int axis) const { return periodicity_.length[axis] > 0.0; }

  /// Calls f(Segment) for the stretches that hold all neighbours of the particles of a cell.
  template <class F>
  void for_each_segment(std::size_t cell, F&& f) const;
  /// The same for the particles of several cells of a row, from the one at `first` to the one whose
  /// index along x is `last`. Not for a single cell.
  template <class F>
  void for_each_segment_around(const std::array<int, D>& first, int last, F&& f) const {
    rows_around(first, last, f);
  }
  [[nodiscard]] std::size_t cell_at(const std::array<int, D>& indices) const {
    std::size_t cell = 0;
    for (int a = D - 1; a >= 0; --a)
      cell = cell * static_cast<std::size_t>(cells_[a]) + static_cast<std::size_t>(indices[a]);
    return cell;
  }

 private:
  template <class T>
  AlignedVector<T>& scratch_for() {
    if constexpr (std::is_same_v<T, double>)
      return scratch_double_;
    else if constexpr (std::is_same_v<T, std::int32_t>)
      return scratch_int_;
    else
      return scratch_type_;
  }
  void choose_cells(const std::array<Field, D>& x, double radius);
  void sort_into_cells(const std::array<Field, D>& x);
  [[nodiscard]] std::array<int, D> cell_indices(std::size_t cell) const;
  template <class F>
  void rows_around(const std::array<int, D>& first, int last, F& f) const;
  template <class F>
  void segments_of_row(const std::array<int, D>& row, int first, int last, Vec<D> shift,
                       F& f) const;

  Search search_;
  Periodicity<D> periodicity_;
  int reach_ = 1;
  Vec<D> origin_{};
  Vec<D> inverse_size_{};
  std::array<int, D> cells_{};
  std::vector<std::size_t> cell_begin_{0, 0};
  std::vector<std::uint32_t> cell_of_, order_;
  std::vector<std::uint32_t> histogram_;      ///< per thread and cell
  std::vector<std::uint32_t> stretch_begin_;  ///< particles in each thread's stretch of the cells
  Field scratch_double_;
  AlignedVector<std::int32_t> scratch_int_;
  AlignedVector<ParticleType> scratch_type_;
};

template <int D>
template <class F>
void CellGrid<D>::for_each_segment(std::size_t cell, F&& f) const {
  if (single_cell()) {
    // One image per period on either side is enough: the case reader checks the period's length.
    std::array<int, D> images{};
    std::size_t combinations = 1;
    for (int a = 0; a < D; ++a) {
      images[a] = is_periodic(a) ? 3 : 1;
      combinations *= static_cast<std::size_t>(images[a]);
    }
    for (std::size_t k = 0; k < combinations; ++k) {
      Vec<D> shift{};
      std::size_t rest = k;
      for (int a = 0; a < D; ++a) {
        const auto n = static_cast<std::size_t>(images[a]);
        if (n == 3) shift[a] = (static_cast<double>(rest % n) - 1.0) * periodicity_.length[a];
        rest /= n;
      }
      f(Segment{0, cell_begin_[1], shift});
    }
    return;
  }
  const std::array<int, D> index = cell_indices(cell);
  rows_around(index, index[0], f);
}

template <int D>
template <class F>
void CellGrid<D>::rows_around(const std::array<int, D>& first, int last, F& f) const {
  const int width = 2 * reach_ + 1;
  int rows = 1;
  for (int a = 1; a < D; ++a) rows *= width;
  for (int k = 0; k < rows; ++k) {
    std::array<int, D> row{};
    Vec<D> shift{};
    bool inside = true;
    int rest = k;
    for (int a = 1; a < D; ++a) {
      row[a] = first[a] + rest % width - reach_;
      rest /= width;
      while (is_periodic(a) && row[a] < 0) row[a] += cells_[a], shift[a] -= periodicity_.length[a];
      while (is_periodic(a) && row[a] >= cells_[a])
        row[a] -= cells_[a], shift[a] += periodicity_.length[a];
      inside = inside && row[a] >= 0 && row[a] < cells_[a];
    }
    if (inside) segments_of_row(row, first[0] - reach_, last + reach_, shift, f);
  }
}

template <int D>
template <class F>
void CellGrid<D>::segments_of_row(const std::array<int, D>& row, int first, int last, Vec<D> shift,
                                  F& f) const {
  std::size_t base = 0;
  for (int a = D - 1; a > 0; --a)
    base = (base + static_cast<std::size_t>(row[a])) * static_cast<std::size_t>(cells_[a - 1]);
  const auto emit = [&](int from, int to, double shift_x) {
    const std::size_t begin = cell_begin_[base + static_cast<std::size_t>(from)];
    const std::size_t end = cell_begin_[base + static_cast<std::size_t>(to) + 1];
    shift[0] = shift_x;
    if (begin < end) f(Segment{begin, end, shift});
  };
  if (!is_periodic(0)) {
    emit(first < 0 ? 0 : first, last >= cells_[0] ? cells_[0] - 1 : last, 0.0);
    return;
  }
  double shift_x = 0.0;
  while (first < 0) first += cells_[0], last += cells_[0], shift_x -= periodicity_.length[0];
  while (last >= cells_[0]) {
    emit(first, cells_[0] - 1, shift_x);
    first = 0;
    last -= cells_[0];
    shift_x += periodicity_.length[0];
  }
  emit(first, last, shift_x);
}

}  // namespace surge
