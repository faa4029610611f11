#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <omp.h>

#include "particle/core/cell_grid.hpp"
#include "particle/core/for_each_cell.hpp"
#include "particle/core/pair_loop.hpp"
#include "particle/core/simd.hpp"

namespace surge {

/// What a pair adds to the sums of its two particles.
template <int A>
struct PairTerms {
  std::array<Simd, A> to_i;
  std::array<Simd, A> to_j;
};

/// Sums over pairs of neighbours in which each pair is evaluated once, for both of its particles:
///   out_a(i) = sum_j to_i(i, j) + sum_j to_j(j, i).
/// F fields are read, positions first; A sums are formed. The memory is kept from step to step.
///
/// Cells are grouped into blocks, and blocks coloured so that no two of one colour add to the same
/// particle: the colours follow each other, the blocks of one colour go beside each other. So
/// every sum has one order of its terms, whatever the number of threads.
template <int D, int F, int A>
class SymmetricPairLoop {
 public:
  using Sources = std::array<const double*, F>;
  using Sums = std::array<double*, A>;

  /// pair(fields of i, fields of j) gives PairTerms<A>, for a whole vector of j. Positions of j are
  /// those of the periodic image that i meets. Lanes that stand for no particle are so far away
  /// that every kernel is zero there, and their other fields are zero. A particle and itself must
  /// give zero. Pairs in which needed(i) holds for neither are left out as far as that is cheap:
  /// any_needed(begin, end) says whether there is such a particle among [begin, end). `sums` are
  /// overwritten, those of particles that are not needed with anything.
  template <class Needed, class AnyNeeded, class Pair>
  void operator()(const CellGrid<D>& grid, const Sources& fields, const Sums& sums, Needed&& needed,
                  AnyNeeded&& any_needed, Pair&& pair) {
    if (grid.single_cell()) {
      meet_all(grid, fields, sums, needed, pair);
      return;
    }
    buffers_.resize(std::max(buffers_.size(), static_cast<std::size_t>(omp_get_max_threads())));
    const Blocks blocks(grid);
#pragma omp parallel
    {
      clear(sums, grid.particle_count());
      Buffer& buffer = buffers_[static_cast<std::size_t>(omp_get_thread_num())];
      for (int colour = 0; colour < (1 << D); ++colour) {
        const std::ptrdiff_t count = blocks.count(colour);
#pragma omp for schedule(dynamic, 1)
        for (std::ptrdiff_t b = 0; b < count; ++b)
          blocks.for_each_cell(colour, b, [&](const std::array<int, D>& cell) {
            const auto [begin, end] = grid.particles_of(grid.cell_at(cell));
            if (begin == end || !buffer.find(grid, cell, any_needed)) return;
            buffer.gather(fields);
            meet(end - begin, buffer, pair);
            buffer.scatter(sums);
          });
      }
    }
  }

 private:
  static constexpr double far_away = 1e15;

  /// Cells in blocks, and the colours of the blocks: one bit per axis, alternating along it.
  class Blocks {
   public:
    explicit Blocks(const CellGrid<D>& grid) : cells_(grid.cells()) {
      std::array<int, D> size;
      double blocks = 1.0;
      for (int a = 0; a < D; ++a) {
        // A block adds to particles at most `reach` cells outside itself on either side.
        size[a] = (a == 0 ? 4 : 2) * std::max(2, grid.reach());
        blocks *= static_cast<double>(cells_[a]) / size[a];
      }
      const double growth = std::max(1.0, std::pow(blocks / enough_blocks, 1.0 / D));
      for (int a = 0; a < D; ++a) {
        blocks_[a] = std::max(1, static_cast<int>(cells_[a] / (growth * size[a])));
        // The last block and the first one meet across a periodic boundary.
        if (grid.is_periodic(a) && blocks_[a] > 1) blocks_[a] -= blocks_[a] % 2;
      }
    }
    [[nodiscard]] std::ptrdiff_t count(int colour) const {
      std::ptrdiff_t n = 1;
      for (int a = 0; a < D; ++a) n *= along(colour, a);
      return n;
    }
    template <class Visit>
    void for_each_cell(int colour, std::ptrdiff_t block, Visit&& visit) const {
      std::array<int, D> begin;
      std::array<int, D> end;
      for (int a = 0; a < D; ++a) {
        const int b = 2 * static_cast<int>(block % along(colour, a)) + ((colour >> a) & 1);
        block /= along(colour, a);
        begin[a] = boundary(b, a);
        end[a] = boundary(b + 1, a);
      }
      surge::for_each_cell<D>(begin, end, visit);
    }

   private:
    /// What lies around a block is read and written with each of its neighbours' colours: where
    /// there are more blocks than threads can use, larger ones save memory traffic.
    static constexpr double enough_blocks = 1024.0;

    [[nodiscard]] int along(int colour, int a) const {
      return (blocks_[a] + 1 - ((colour >> a) & 1)) / 2;
    }
    [[nodiscard]] int boundary(int block, int a) const {
      return static_cast<int>(static_cast<long>(cells_[a]) * block / blocks_[a]);
    }
    std::array<int, D> cells_;
    std::array<int, D> blocks_{};
  };

  /// The particles that a cell meets, field beside field, and what they get from it.
  class alignas(128) Buffer {
   public:
    std::array<double*, F> field;
    std::array<double*, A> sum;
    std::size_t padded = 0;

    /// Whether the cell has anything to do.
    template <class AnyNeeded>
    bool find(const CellGrid<D>& grid, const std::array<int, D>& cell, AnyNeeded& any_needed) {
      segments_.clear();
      bool found = false;
      std::size_t count = 0;
      grid.for_each_forward_segment(cell, [&](const auto& s) {
        segments_.push_back(s);
        count += s.end - s.begin;
        found = found || any_needed(s.begin, s.end);
      });
      if (found) reserve(count);
      return found;
    }

    void gather(const Sources& in) {
      for (int k = 0; k < F; ++k) {
        double* out = field[k];
        for (const auto& s : segments_) {
          copy_run(in[k] + s.begin, s.end - s.begin, k < D ? s.shift[k] : 0.0, out);
          out += s.end - s.begin;
        }
        std::fill(out, field[k] + padded, k < D ? far_away : 0.0);
      }
      for (int a = 0; a < A; ++a) std::fill_n(sum[a], padded, 0.0);
    }

    void scatter(const Sums& out) const {
      for (int a = 0; a < A; ++a) {
        const double* from = sum[a];
        for (const auto& s : segments_) {
          add_run(from, s.end - s.begin, out[a] + s.begin);
          from += s.end - s.begin;
        }
      }
    }

   private:
    void reserve(std::size_t count) {
      padded = (count + simd_width - 1) / simd_width * simd_width;
      if (padded > capacity_) {
        // An odd number of cache lines between the fields keeps them out of each other's sets.
        capacity_ = (padded * 3 / 2 + 7) / 8 * 8 | 8;
        data_.resize(capacity_ * (F + A));
      }
      for (std::size_t k = 0; k < F; ++k) field[k] = data_.data() + k * capacity_;
      for (std::size_t a = 0; a < A; ++a) sum[a] = data_.data() + (F + a) * capacity_;
    }
    std::vector<typename CellGrid<D>::Segment> segments_;
    Field data_;
    std::size_t capacity_ = 0;
  };

  /// To be called by a whole team of threads.
  static void clear(const Sums& sums, std::size_t particles) {
    const auto n = static_cast<std::ptrdiff_t>(particles);
#pragma omp for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
      for (int a = 0; a < A; ++a) sums[a][i] = 0.0;
  }

  /// The first `own` particles of the buffer meet each other and all that come after them.
  template <class Pair>
  static void meet(std::size_t own, Buffer& buffer, Pair& pair) {
    const Simd lane([](int k) { return static_cast<double>(k); });
    for (std::size_t i = 0; i < own; ++i) {
      std::array<Simd, F> fi;
      for (int k = 0; k < F; ++k) fi[k] = buffer.field[k][i];
      std::array<Simd, A> total{};
      const auto add = [&](std::size_t j, auto&& mask) {
        std::array<Simd, F> fj;
        for (int k = 0; k < F; ++k) fj[k] = load(buffer.field[k] + j);
        PairTerms<A> terms = pair(fi, fj);
        for (int a = 0; a < A; ++a) {
          mask(terms.to_i[a]);
          mask(terms.to_j[a]);
          total[a] += terms.to_i[a];
          const Simd sum = load(buffer.sum[a] + j) + terms.to_j[a];
          sum.copy_to(buffer.sum[a] + j, stdx::vector_aligned);
        }
      };
      // In the cell's own first vectors, only the particles after i are new to it.
      const std::size_t first = i / simd_width * simd_width;
      const Simd self = static_cast<double>(i - first);
      add(first, [&](Simd& term) { stdx::where(lane <= self, term) = 0.0; });
      for (std::size_t j = first + simd_width; j < buffer.padded; j += simd_width)
        add(j, [](Simd&) {});
      for (int a = 0; a < A; ++a) buffer.sum[a][i] += stdx::reduce(total[a]);
    }
  }

  /// The search over all pairs, as the paper has it: everyone meets everyone, each pair twice.
  template <class Needed, class Pair>
  void meet_all(const CellGrid<D>& grid, const Sources& fields, const Sums& sums, Needed& needed,
                Pair& pair) {
    const auto body = [&](std::size_t i, const Tile<F>& tile) {
      if (!needed(i)) return;
      std::array<Simd, F> fi;
      for (int k = 0; k < F; ++k) fi[k] = fields[k][i];
      std::array<Simd, A> total{};
      for (std::size_t j = 0; j < tile.count; j += simd_width) {
        std::array<Simd, F> fj;
        for (int k = 0; k < F; ++k) fj[k] = load(tile.field[k] + j);
        const PairTerms<A> terms = pair(fi, fj);
        for (int a = 0; a < A; ++a) total[a] += terms.to_i[a];
      }
      for (int a = 0; a < A; ++a) sums[a][i] = stdx::reduce(total[a]);
    };
    pair_loop<D, F>(
        grid, everyone_, fields, [](std::size_t) { return true; }, body);
  }

  std::vector<Buffer> buffers_;
  std::vector<TileBuffer<D, F>> everyone_;
};

}  // namespace surge
