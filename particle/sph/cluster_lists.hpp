#pragma once

#include <omp.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "particle/core/cell_grid.hpp"
#include "particle/core/neighbour_lanes.hpp"
#include "particle/core/parallel_for.hpp"
#include "particle/core/particles.hpp"
#include "particle/core/prefix_sums.hpp"
#include "particle/core/simd.hpp"

namespace surge::sph {

/// From particles i, as many as the processor works on at once, to one neighbour j.
template <int D>
struct Offset {
  std::array<Simd, D> dx;  ///< x_j - x_i, m
  Simd r2;                 ///< |dx|^2, m2; `tiny` more, so that r > 0 for a particle and itself
  Simd r;                  ///< m
};

inline constexpr double tiny = 1e-30;  ///< m2

/// Neighbours of clusters of particles, kept while the particles move a little, and sums over them.
///
/// A cluster is a few particles of one kind that lie side by side, as many as the processor works
/// on at once, with one list of all that any of them may meet (Pall & Hess 2013, Comput. Phys.
/// Commun. 184). A sum goes through the list, one neighbour against the whole cluster: what is read
/// of the neighbour is one short stretch of memory, the cluster's own numbers and sums stay in
/// registers, and nothing is picked lane by lane. Each particle has its sum from its own cluster
/// alone, so that the order of its terms does not depend on the number of threads.
template <int D>
class ClusterLists {
 public:
  enum class Of { fluid, walls };

  /// The lists of all pairs closer than `radius` (m) that the water has a part in, for particles in
  /// the order of the grid, which was built for this radius or a larger one: of the fluid with
  /// fluid and walls, and of walls with fluid, or, with walls_meet_walls, with walls too where
  /// there is fluid. Walls that no water is near to cost nothing. Of a grid with a single cell
  /// everybody's list is everybody, as in the paper's search.
  void build(const CellGrid<D>& grid, const Particles<D>& p, double radius,
             bool walls_meet_walls = false);

  /// Number of fluid particles among the first i.
  [[nodiscard]] const std::vector<std::uint32_t>& fluid_before() const { return fluid_before_; }

  /// sums[a][i] = sum over j for the particles of a kind that have neighbours; those of others are
  /// left alone. `sources` are F fields, positions first, of which neighbours show the first J.
  /// pair(offset, i, j, total, kind) adds to total: an Offset<D>, the F fields of i, the J of j, A
  /// sums, and std::true_type where j is fluid, std::false_type where it is a wall. The same pair
  /// is met from either side, j beyond the radius and i itself are met too: every kernel must be
  /// zero there, and the term of a particle and itself. Clusters for which wanted(cluster) does not
  /// hold get zeros.
  template <int F, int J, int A, class Pair, class Wanted>
  void sum(Of kind, const std::array<const double*, F>& sources, const std::array<double*, A>& sums,
           Pair&& pair, Wanted&& wanted);
  template <int F, int J, int A, class Pair>
  void sum(Of kind, const std::array<const double*, F>& sources, const std::array<double*, A>& sums,
           Pair&& pair) {
    sum<F, J, A>(kind, sources, sums, pair, [](const auto&...) { return true; });
  }

  /// f(i) for the particles of a kind that have neighbours.
  template <class F>
  void for_each(Of kind, F&& f) const {
    const auto rows = static_cast<std::ptrdiff_t>(near_.size());
    parallel_for(rows, few_rows, [&](std::ptrdiff_t r) {
      for (const Cluster& cluster : rows_[r].clusters[static_cast<std::size_t>(kind)])
        for (std::uint32_t lane = 0; lane < cluster.count; ++lane)
          f(std::size_t{cluster.member[lane]});
    });
  }

  /// Neighbours of one kind, seen as the periodic image that is `shift` away.
  struct Run {
    std::uint32_t begin;
    std::uint32_t end;
    bool fluid;
    Vec<D> shift;
  };
  struct Cluster {
    LaneIndices member;  ///< the last one again where there are fewer
    std::uint32_t count;
    std::uint32_t first_run;
    std::uint32_t end_run;
  };
  /// The particles of a row of cells that water is near to.
  struct Row {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::array<std::vector<Cluster>, 2> clusters;  ///< by Of
    std::vector<Run> runs;
    AlignedVector<std::uint32_t> neighbours;
    std::size_t listed = 0;  ///< of neighbours

    /// f(index) of the neighbours that are fluid.
    template <class F>
    void for_each_fluid_neighbour(const Cluster& cluster, F&& f) const {
      for (std::uint32_t k = cluster.first_run; k < cluster.end_run; ++k)
        for (std::uint32_t j = runs[k].begin; runs[k].fluid && j < runs[k].end; ++j)
          f(std::size_t{neighbours[j]});
    }
  };

 private:
  struct Member {
    double x;  ///< along the row, m
    std::uint32_t index;
    int cell;
  };
  /// Of a thread.
  struct Scratch {
    std::array<std::vector<Member>, 2> members;  ///< by Of
    AlignedVector<std::uint32_t> walls;
  };

  void find_rows(const CellGrid<D>& grid);
  void fill(const CellGrid<D>& grid, const Particles<D>& p, double radius, std::size_t row,
            Row& out, Scratch& scratch) const;
  void list_neighbours(const CellGrid<D>& grid, const Particles<D>& p, double radius, Of kind,
                       const std::array<int, D>& first, int last, const Cluster& cluster, Row& out,
                       Scratch& scratch) const;
  void everybody(const CellGrid<D>& grid, const Particles<D>& p);
  [[nodiscard]] bool any_fluid(std::size_t begin, std::size_t end) const {
    return fluid_before_[end] > fluid_before_[begin];
  }

  bool walls_meet_walls_ = false;
  std::vector<std::uint32_t> fluid_before_;
  std::vector<std::uint32_t> near_;  ///< rows that water is near to
  std::vector<Row> rows_;            ///< of them; more than there are now
  std::vector<Scratch> scratch_;     ///< by thread
  PrefixSums prefix_sums_;
  /// Rows that are packed, or gone through once, faster than threads are woken.
  static constexpr std::ptrdiff_t few_rows = 64;
  Field packed_;  ///< what neighbours show, particle by particle
};

template <int D>
template <int F, int J, int A, class Pair, class Wanted>
void ClusterLists<D>::sum(Of kind, const std::array<const double*, F>& sources,
                          const std::array<double*, A>& sums, Pair&& pair, Wanted&& wanted) {
  packed_.resize(J * (fluid_before_.size() - 1));
  const auto rows = static_cast<std::ptrdiff_t>(near_.size());
  parallel_for(rows, few_rows, [&](std::ptrdiff_t r) {
    for (std::size_t i = rows_[r].begin; i < rows_[r].end; ++i)
      for (int k = 0; k < J; ++k) packed_[J * i + static_cast<std::size_t>(k)] = sources[k][i];
  });
  parallel_for_in_turn(rows, 1, [&](std::ptrdiff_t r, std::size_t) {
    const Row& row = rows_[r];
    for (const Cluster& cluster : row.clusters[static_cast<std::size_t>(kind)]) {
      std::array<Simd, A> total{};
      if (wanted(row, cluster)) {
        std::array<Simd, F> i;
        for (int k = 0; k < F; ++k)
          i[k] = Simd([&](auto lane) { return sources[k][cluster.member[lane]]; });
        for (std::uint32_t k = cluster.first_run; k < cluster.end_run; ++k) {
          const Run& run = row.runs[k];
          std::array<Simd, D> x;
          for (int a = 0; a < D; ++a) x[a] = i[a] - Simd(run.shift[a]);
          const auto meet = [&](auto is_fluid) SURGE_INLINE {
            const std::uint32_t* const end = row.neighbours.data() + run.end;
            for (const std::uint32_t* n = row.neighbours.data() + run.begin; n < end; ++n) {
              const double* const of_j = packed_.data() + std::size_t{J} * *n;
              std::array<Simd, J> j;
              for (int f = 0; f < J; ++f) j[f] = of_j[f];
              Offset<D> offset;
              offset.r2 = tiny;
              for (int a = 0; a < D; ++a) {
                offset.dx[a] = j[a] - x[a];
                offset.r2 += offset.dx[a] * offset.dx[a];
              }
              offset.r = root(offset.r2);
              pair(offset, i, j, total, is_fluid);
            }
          };
          if (run.fluid)
            meet(std::true_type{});
          else
            meet(std::false_type{});
        }
      }
      for (int a = 0; a < A; ++a)
        for (std::uint32_t lane = 0; lane < cluster.count; ++lane)
          sums[a][cluster.member[lane]] = total[a][lane];
    }
  });
}

}  // namespace surge::sph
