#pragma once

#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "particle/core/pair_loop.hpp"

namespace surge {

/// x_j - x_i of the nearest periodic image, m.
template <int D>
class Displacement {
 public:
  Displacement(const std::array<Field, D>& x, const Periodicity<D>& periodicity)
      : x_(x), length_(periodicity.length) {
    for (int a = 0; a < D; ++a) inverse_[a] = length_[a] > 0.0 ? 1.0 / length_[a] : 0.0;
    periodic_ = std::any_of(length_.begin(), length_.end(), [](double l) { return l > 0.0; });
  }

  Vec<D> operator()(std::size_t i, std::size_t j) const {
    Vec<D> d;
    for (int a = 0; a < D; ++a) d[a] = x_[a][j] - x_[a][i];
    if (periodic_)
      for (int a = 0; a < D; ++a) d[a] -= length_[a] * std::nearbyint(d[a] * inverse_[a]);
    return d;
  }

  [[nodiscard]] const double* positions(int axis) const { return x_[axis].data(); }
  [[nodiscard]] bool is_periodic() const { return periodic_; }
  [[nodiscard]] double length(int axis) const { return length_[axis]; }  ///< m; 0: not periodic
  [[nodiscard]] double inverse_length(int axis) const { return inverse_[axis]; }

 private:
  const std::array<Field, D>& x_;
  Vec<D> length_;
  Vec<D> inverse_;
  bool periodic_;
};

template <int D>
double squared_norm(const Vec<D>& d) {
  double sum = 0.0;
  for (const double c : d) sum += c * c;
  return sum;
}

/// For each particle the indices of the particles closer than a radius, itself not among them, in
/// ascending order where no axis is periodic. Results do not depend on the number of threads.
template <int D>
class NeighbourList {
 public:
  /// Lists the neighbours within `radius` (m) of every particle i for which wanted(i) holds; the
  /// others get empty lists. The grid must have been built for at least that radius.
  template <class Wanted>
  void build(const CellGrid<D>& grid, const std::array<Field, D>& x, double radius,
             Wanted&& wanted) {
    build(
        grid, x, radius, [](std::size_t) { return true; }, wanted);
  }
  /// The same where cell_wanted(cell) holds as well: the others' particles cost nothing.
  template <class CellWanted, class Wanted>
  void build(const CellGrid<D>& grid, const std::array<Field, D>& x, double radius,
             CellWanted&& cell_wanted, Wanted&& wanted) {
    const std::size_t n = x[0].size();
    if (number_.size() != n) {
      number_.resize(n);
      std::iota(number_.begin(), number_.end(), 0.0);
    }
    range_.assign(n, Range{0, 0, 0});
    chunk_.resize(std::max(chunk_.size(), static_cast<std::size_t>(omp_get_max_threads())));
    for (auto& chunk : chunk_) chunk.entry.clear();

    std::array<const double*, D + 1> fields;
    for (int a = 0; a < D; ++a) fields[a] = x[a].data();
    fields[D] = number_.data();
    const double radius2 = radius * radius;
    pair_loop<D, D + 1>(grid, buffers_, fields, cell_wanted,
                        [&](std::size_t i, const Tile<D + 1>& tile, std::size_t thread) {
                          if (wanted(i)) list_neighbours(i, x, radius2, tile, thread);
                        });
  }

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const {
    const Range& r = range_[i];
    return {chunk_[r.thread].entry.data() + r.begin, r.count};
  }

 private:
  /// On cache lines of its own: a thread changes its size with every particle.
  struct alignas(128) Chunk {
    AlignedVector<std::uint32_t> entry;  // new entries are not set to zero first
  };
  struct Range {
    std::size_t begin;
    std::uint32_t count;
    std::uint32_t thread;
  };

  void list_neighbours(std::size_t i, const std::array<Field, D>& x, double radius2,
                       const Tile<D + 1>& tile, std::size_t thread) {
    auto& chunk = chunk_[thread].entry;
    const std::size_t begin = chunk.size();
    chunk.resize(begin + tile.count);
    std::uint32_t* out = chunk.data() + begin;
    std::size_t count = 0;
    alignas(64) std::array<double, simd_width> r2;
    for (std::size_t first = 0; first < tile.count; first += simd_width) {
      Simd square = 0.0;
      for (int a = 0; a < D; ++a) {
        const Simd d = load(tile.field[a] + first) - x[a][i];
        square += d * d;
      }
      if (stdx::none_of(square < radius2)) continue;
      square.copy_to(r2.data(), stdx::vector_aligned);
      for (std::size_t k = 0; k < simd_width; ++k) {
        const auto index = static_cast<std::uint32_t>(tile.field[D][first + k]);
        out[count] = index;
        count += static_cast<std::size_t>((r2[k] < radius2) & (index != i));
      }
    }
    chunk.resize(begin + count);
    range_[i] = {begin, static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(thread)};
  }

  Field number_;  ///< 0, 1, 2, ...: travels with the positions through the tiles
  std::vector<Range> range_;
  std::vector<Chunk> chunk_;  ///< one per thread
  std::vector<TileBuffer<D, D + 1>> buffers_;
};

}  // namespace surge
