#include "particle/sph/cluster_lists.hpp"

#include <algorithm>
#include <span>

#include "particle/core/parallel_for.hpp"

namespace surge::sph {
namespace {

/// Cells along y (and z): the rows of a grid.
template <int D>
std::size_t rows_of(const CellGrid<D>& grid) {
  std::size_t rows = 1;
  for (int a = 1; a < D; ++a) rows *= static_cast<std::size_t>(grid.cells()[a]);
  return rows;
}

/// The first cell of a row.
template <int D>
std::array<int, D> start_of(const CellGrid<D>& grid, std::size_t row) {
  std::array<int, D> index{};
  for (int a = 1; a < D; ++a) {
    const auto n = static_cast<std::size_t>(grid.cells()[a]);
    index[a] = static_cast<int>(row % n);
    row /= n;
  }
  return index;
}

}  // namespace

template <int D>
void ClusterLists<D>::build(const CellGrid<D>& grid, const Particles<D>& p, double radius,
                            bool walls_meet_walls) {
  walls_meet_walls_ = walls_meet_walls;
  fluid_before_.resize(p.size() + 1);
  prefix_sums_(
      p.size(), [&](std::size_t i) { return p.type[i] == ParticleType::fluid ? 1 : 0; },
      fluid_before_.data());
  scratch_.resize(std::max(scratch_.size(), static_cast<std::size_t>(omp_get_max_threads())));
  if (grid.single_cell()) {
    everybody(grid, p);
    return;
  }
  find_rows(grid);
  if (rows_.size() < near_.size()) rows_.resize(near_.size());
  const auto rows = static_cast<std::ptrdiff_t>(near_.size());
  parallel_for_in_turn(rows, 1, [&](std::ptrdiff_t r, std::size_t thread) {
    fill(grid, p, radius, near_[r], rows_[r], scratch_[thread]);
  });
}

template <int D>
void ClusterLists<D>::find_rows(const CellGrid<D>& grid) {
  near_.clear();
  const std::size_t rows = rows_of(grid);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::array<int, D> first = start_of(grid, row);
    bool found = false;
    grid.for_each_segment_around(first, grid.cells()[0] - 1, [&](const auto& s) {
      found = found || any_fluid(s.begin, s.end);
    });
    if (found) near_.push_back(static_cast<std::uint32_t>(row));
  }
}

/// Particles of the row in the order of x, by kind, as many as fit into a cluster at a time.
template <int D>
void ClusterLists<D>::fill(const CellGrid<D>& grid, const Particles<D>& p, double radius,
                           std::size_t row, Row& out, Scratch& scratch) const {
  // Members farther apart than this would have little of their list in common.
  const double longest = 0.25 * static_cast<double>(simd_width) * radius;
  std::array<int, D> index = start_of(grid, row);
  for (auto& members : scratch.members) members.clear();
  out.begin = grid.particles_of(grid.cell_at(index)).first;
  for (; index[0] < grid.cells()[0]; ++index[0]) {
    const auto [begin, end] = grid.particles_of(grid.cell_at(index));
    for (std::size_t i = begin; i < end; ++i) {
      auto& members = scratch.members[p.type[i] == ParticleType::fluid ? 0 : 1];
      // Already in order but within a cell.
      members.push_back({p.x[0][i], static_cast<std::uint32_t>(i), index[0]});
      for (std::size_t k = members.size() - 1; k > 0 && members[k].x < members[k - 1].x; --k)
        std::swap(members[k], members[k - 1]);
    }
    out.end = end;
  }
  index[0] = 0;
  out.runs.clear();
  out.listed = 0;
  for (const Of kind : {Of::fluid, Of::walls}) {
    const auto& members = scratch.members[static_cast<std::size_t>(kind)];
    auto& clusters = out.clusters[static_cast<std::size_t>(kind)];
    clusters.clear();
    for (std::size_t begin = 0, end; begin < members.size(); begin = end) {
      Cluster cluster;
      std::array<int, D> first = index;
      first[0] = members[begin].cell;
      int last = first[0];
      for (end = begin; end < members.size() && end - begin < simd_width &&
                        members[end].x - members[begin].x <= longest;
           ++end) {
        first[0] = std::min(first[0], members[end].cell);
        last = std::max(last, members[end].cell);
      }
      cluster.count = static_cast<std::uint32_t>(end - begin);
      for (std::size_t lane = 0; lane < simd_width; ++lane)
        cluster.member[lane] = members[std::min(begin + lane, end - 1)].index;
      cluster.first_run = static_cast<std::uint32_t>(out.runs.size());
      list_neighbours(grid, p, radius, kind, first, last, cluster, out, scratch);
      cluster.end_run = static_cast<std::uint32_t>(out.runs.size());
      // Of walls alone there is nothing to sum.
      const auto met = std::span(out.runs).subspan(cluster.first_run);
      if (std::any_of(met.begin(), met.end(), [](const Run& run) { return run.fluid; }))
        clusters.push_back(cluster);
    }
  }
}

template <int D>
void ClusterLists<D>::list_neighbours(const CellGrid<D>& grid, const Particles<D>& p, double radius,
                                      Of kind, const std::array<int, D>& first, int last,
                                      const Cluster& cluster, Row& out, Scratch& scratch) const {
  std::array<Simd, D> xi;
  for (int a = 0; a < D; ++a) xi[a] = pick(p.x[a], cluster.member);
  const Simd radius2 = radius * radius;
  const bool with_walls = kind == Of::fluid || walls_meet_walls_;
  Vec<D> shift{};
  std::size_t fluids = 0;
  std::size_t walls = 0;
  const auto flush = [&] {
    if (fluids > 0) {
      const auto begin = static_cast<std::uint32_t>(out.listed);
      out.listed += fluids;
      out.runs.push_back({begin, static_cast<std::uint32_t>(out.listed), true, shift});
    }
    if (walls > 0) {
      std::copy_n(scratch.walls.begin(), walls, out.neighbours.begin() + out.listed);
      const auto begin = static_cast<std::uint32_t>(out.listed);
      out.listed += walls;
      out.runs.push_back({begin, static_cast<std::uint32_t>(out.listed), false, shift});
    }
    fluids = 0;
    walls = 0;
  };
  grid.for_each_segment_around(first, last, [&](const auto& s) {
    if (!with_walls && !any_fluid(s.begin, s.end)) return;
    if (s.shift != shift) flush();
    shift = s.shift;
    const std::size_t room = s.end - s.begin;
    if (out.neighbours.size() < out.listed + fluids + walls + room)
      out.neighbours.resize(2 * (out.listed + fluids + walls + room));
    if (scratch.walls.size() < walls + room) scratch.walls.resize(2 * (walls + room));
    std::array<Simd, D> x;
    for (int a = 0; a < D; ++a) x[a] = xi[a] - Simd(shift[a]);
    std::uint32_t* const to_fluid = out.neighbours.data() + out.listed;
    std::uint32_t* const to_walls = scratch.walls.data();
    for (std::size_t j = s.begin; j < s.end; ++j) {
      Simd r2 = 0.0;
      for (int a = 0; a < D; ++a) {
        const Simd dx = Simd(p.x[a][j]) - x[a];
        r2 += dx * dx;
      }
      const bool near = stdx::any_of(r2 <= radius2);
      const bool is_fluid = p.type[j] == ParticleType::fluid;
      to_fluid[fluids] = static_cast<std::uint32_t>(j);
      fluids += near && is_fluid ? 1 : 0;
      to_walls[walls] = static_cast<std::uint32_t>(j);
      walls += near && !is_fluid && with_walls ? 1 : 0;
    }
  });
  flush();
}

/// All particles in every list, some clusters at a time.
template <int D>
void ClusterLists<D>::everybody(const CellGrid<D>& grid, const Particles<D>& p) {
  constexpr std::size_t share = 16 * simd_width;
  const std::size_t n = p.size();
  const std::size_t fluid = fluid_before_[n];
  near_.resize((n + share - 1) / share);
  rows_.resize(near_.size());
  for (std::size_t r = 0; r < near_.size(); ++r) {
    Row& row = rows_[r];
    row.begin = r * share;
    row.end = std::min(n, row.begin + share);
    row.runs.clear();
    row.neighbours.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = fluid_before_[i];
      const bool is_fluid = p.type[i] == ParticleType::fluid;
      row.neighbours[is_fluid ? before : fluid + i - before] = static_cast<std::uint32_t>(i);
    }
    // Fluid first, which may be all that walls meet.
    std::uint32_t images = 0;
    const auto add_runs = [&](std::size_t begin, std::size_t end, bool is_fluid) {
      grid.for_each_segment(0, [&](const auto& s) {
        row.runs.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
                            is_fluid, s.shift});
        images += is_fluid ? 1 : 0;
      });
    };
    add_runs(0, fluid, true);
    add_runs(fluid, n, false);
    for (const Of kind : {Of::fluid, Of::walls}) {
      auto& clusters = row.clusters[static_cast<std::size_t>(kind)];
      clusters.clear();
      for (std::size_t i = row.begin; i < row.end; ++i) {
        if ((p.type[i] == ParticleType::fluid) != (kind == Of::fluid)) continue;
        if (clusters.empty() || clusters.back().count == simd_width) {
          const auto runs = static_cast<std::uint32_t>(row.runs.size());
          clusters.push_back({{}, 0, 0, kind == Of::fluid || walls_meet_walls_ ? runs : images});
        }
        Cluster& cluster = clusters.back();
        std::fill(cluster.member.begin() + cluster.count, cluster.member.end(),
                  static_cast<std::uint32_t>(i));
        ++cluster.count;
      }
    }
  }
}

template class ClusterLists<2>;
template class ClusterLists<3>;

}  // namespace surge::sph
