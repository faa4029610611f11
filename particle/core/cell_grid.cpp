#include "particle/core/cell_grid.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/core/extremes.hpp"
#include "particle/core/parallel_for.hpp"
#include "particle/support/error.hpp"

namespace surge {
namespace {

/// Waits for all threads of a team, where there are others.
void meet(std::size_t team) {
  if (team == 1) return;
#pragma omp barrier
}

}  // namespace

template <int D>
Periodicity<D> periodicity_of(const Case& c) {
  Periodicity<D> p;
  if (!c.has_tank) return p;
  for (int a = 0; a < D; ++a) {
    if (!c.tank.periodic[a]) continue;
    p.lower[a] = c.tank.box.lower[a];
    p.length[a] = c.tank.box.upper[a] - c.tank.box.lower[a];
  }
  return p;
}

template <int D>
void CellGrid<D>::build(std::array<Field, D>& x, double radius, int reach) {
  const auto n = static_cast<std::ptrdiff_t>(x[0].size());
  for (int a = 0; a < D; ++a) {
    if (!is_periodic(a)) continue;
    const double lower = periodicity_.lower[a];
    const double length = periodicity_.length[a];
    parallel_for(n, worth_sharing, [&](std::ptrdiff_t i) {
      x[a][i] -= length * std::floor((x[a][i] - lower) / length);
    });
  }
  reach_ = reach;
  if (single_cell()) {
    cell_begin_ = {0, x[0].size()};
    return;
  }
  choose_cells(x, radius);
  sort_into_cells(x);
}

template <int D>
void CellGrid<D>::choose_cells(const std::array<Field, D>& x, double radius) {
  const auto n = static_cast<std::ptrdiff_t>(x[0].size());
  const double wanted = radius / reach_;
  double size = wanted;
  Vec<D> extent{};
  for (int a = 0; a < D; ++a) {
    const double* at = x[a].data();
    const auto [lower, upper, finite] = extremes_of(n, [&](std::ptrdiff_t i) { return at[i]; });
    if (!finite) throw Error("a particle's position is not finite: the simulation has broken up");
    origin_[a] = is_periodic(a) ? periodicity_.lower[a] : lower;
    extent[a] = is_periodic(a) ? periodicity_.length[a] : upper - lower;
  }
  // A few particles far away must not ask for more cells than there are particles to sort.
  const double limit = 4.0 * static_cast<double>(n) + 1024.0;
  const auto total = [&](double s) {
    double cells = 1.0;
    for (int a = 0; a < D; ++a) cells *= std::floor(extent[a] / s) + 1.0;
    return cells;
  };
  while (total(size) > limit) size *= 1.25;
  for (int a = 0; a < D; ++a) {
    const double whole = std::floor(extent[a] / size);
    cells_[a] = std::max(1, static_cast<int>(is_periodic(a) ? whole : whole + 1.0));
    inverse_size_[a] = is_periodic(a) ? cells_[a] / extent[a] : 1.0 / size;
  }
}

template <int D>
void CellGrid<D>::sort_into_cells(const std::array<Field, D>& x) {
  const std::size_t n = x[0].size();
  std::size_t cells = 1;
  for (int a = 0; a < D; ++a) cells *= static_cast<std::size_t>(cells_[a]);
  const bool shared = is_shared(static_cast<std::ptrdiff_t>(n), worth_sharing);
  const auto threads = shared ? static_cast<std::size_t>(omp_get_max_threads()) : 1;
  cell_of_.resize(n);
  order_.resize(n);
  cell_begin_.resize(cells + 1);
  histogram_.resize(threads * cells);
  stretch_begin_.resize(threads);

  // Stable counting sort: each thread counts and later places one stretch of the old order, so the
  // new order does not depend on the number of threads.
  const auto sort = [&](std::size_t t, std::size_t team) {
    const std::size_t begin = n * t / team;
    const std::size_t end = n * (t + 1) / team;
    std::uint32_t* count = histogram_.data() + t * cells;
    std::fill_n(count, cells, 0);
    for (std::size_t i = begin; i < end; ++i) {
      std::size_t cell = 0;
      for (int a = D - 1; a >= 0; --a) {
        const int k = static_cast<int>((x[a][i] - origin_[a]) * inverse_size_[a]);
        cell = cell * static_cast<std::size_t>(cells_[a]) +
               static_cast<std::size_t>(std::clamp(k, 0, cells_[a] - 1));
      }
      cell_of_[i] = static_cast<std::uint32_t>(cell);
      ++count[cell];
    }
    meet(team);
    // Where each cell begins, and in it each thread: every thread does a stretch of the cells.
    const std::size_t first = cells * t / team;
    const std::size_t last = cells * (t + 1) / team;
    std::uint32_t in_stretch = 0;
    for (std::size_t k = 0; team > 1 && k < team; ++k)
      for (std::size_t c = first; c < last; ++c) in_stretch += histogram_[k * cells + c];
    stretch_begin_[t] = in_stretch;
    meet(team);
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < t; ++k) sum += stretch_begin_[k];
    for (std::size_t c = first; c < last; ++c) {
      cell_begin_[c] = sum;
      for (std::size_t k = 0; k < team; ++k) {
        const std::uint32_t here = histogram_[k * cells + c];
        histogram_[k * cells + c] = sum;
        sum += here;
      }
    }
    if (t + 1 == team) cell_begin_[cells] = sum;
    meet(team);
    for (std::size_t i = begin; i < end; ++i)
      order_[count[cell_of_[i]]++] = static_cast<std::uint32_t>(i);
  };
  if (!shared) {
    sort(0, 1);
    return;
  }
#pragma omp parallel num_threads(static_cast <int>(threads))
  sort(static_cast<std::size_t>(omp_get_thread_num()),
       static_cast<std::size_t>(omp_get_num_threads()));
}

template <int D>
std::array<int, D> CellGrid<D>::cell_indices(std::size_t cell) const {
  std::array<int, D> index{};
  for (int a = 0; a < D; ++a) {
    const auto n = static_cast<std::size_t>(cells_[a]);
    index[a] = static_cast<int>(cell % n);
    cell /= n;
  }
  return index;
}

template Periodicity<2> periodicity_of<2>(const Case&);
template Periodicity<3> periodicity_of<3>(const Case&);
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace surge
