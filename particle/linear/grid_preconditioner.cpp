#include "particle/linear/grid_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/core/extremes.hpp"
#include "particle/core/parallel_for.hpp"

namespace surge::linear {

namespace {

// Weight of the grid against the diagonal: measured, flat between 0.5 and 1.
constexpr double grid_weight = 0.7;

// The largest number 2 m 2^k, m = 4 to 7, up to `limit`: it can be halved often and stays even.
std::int32_t even_cells(double limit) {
  std::int32_t cells = 4;
  for (std::int32_t scale = 2; 4.0 * scale <= limit && scale < (1 << 24); scale *= 2) {
    cells = scale * static_cast<std::int32_t>(std::clamp(std::floor(limit / scale), 4.0, 7.0));
  }
  return cells;
}

/// The least number m 2^k of at least `need` cells that halves down to m, so that both ends of the
/// grid stay nodes on every level. (m + 1)^D nodes are few enough for the coarsest.
template <int D>
std::int64_t halvable_cells(std::int64_t need) {
  constexpr std::int64_t most = D == 2 ? 7 : 3;
  std::int64_t scale = 2;
  while (most * scale < need) scale *= 2;
  return (need + scale - 1) / scale * scale;
}

}  // namespace

template <int D>
void GridPreconditioner<D>::setup(const PoissonSystem& system, const Field& excess, double width) {
  const auto n = static_cast<std::int32_t>(system.size());
  inverse_diagonal_.resize(system.size());
  parallel_for(n, worth_sharing, [&](std::int32_t i) {
    const auto at = static_cast<std::size_t>(i);
    inverse_diagonal_[at] = 1.0 / system.diagonal[at];
  });
  lay_grid(system, width);
  sort_into_cells(system);
  connect_nodes();
  compute_elements(system, excess);
  assemble();
  grid_.build();
}

// Lines of the grid lie to both sides of the middle of the box that the particles fill, so that the
// grid of a flow in a mirror is the grid in the mirror. A particle far away must not make that box
// huge: then the grid is wrapped around, and cells far apart share their nodes.
template <int D>
void GridPreconditioner<D>::lay_grid(const PoissonSystem& system, double width) {
  constexpr double far = 1e9;
  const auto n = static_cast<std::int32_t>(system.size());
  const auto most = static_cast<std::int64_t>(8 * system.size() + 4096);
  std::array<std::int64_t, D> extent{};
  std::array<bool, D> wrapped{};
  for (std::size_t a = 0; a < D; ++a) {
    if (system.period[a] > 0.0) {
      wrapped[a] = true;
      extent[a] = even_cells(system.period[a] / width);
      width_[a] = system.period[a] / static_cast<double>(extent[a]);
      middle_[a] = 0.5 * system.period[a];
      continue;
    }
    width_[a] = width;
    const double* x = system.x[a].data();
    const Extremes range = extremes_of(n, [&](std::int32_t i) { return x[i]; });
    middle_[a] = 0.5 * (range.low + range.high);
    const double need = std::min(std::floor((range.high - range.low) / width), far);
    extent[a] = halvable_cells<D>(static_cast<std::int64_t>(need) + 1);
  }
  const auto volume = [&] {
    double product = 1.0;
    for (const std::int64_t e : extent) product *= static_cast<double>(e);
    return product;
  };
  while (volume() > static_cast<double>(most)) {
    const auto longest =
        static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
    if (!wrapped[longest]) {
      wrapped[longest] = true;
      extent[longest] = 2 * even_cells(static_cast<double>(extent[longest]));
    }
    extent[longest] /= 2;
  }

  typename GridIndex<D>::Coordinate cells{};
  typename GridIndex<D>::Coordinate nodes{};
  for (std::size_t a = 0; a < D; ++a) {
    cells[a] = static_cast<std::int32_t>(extent[a]);
    nodes[a] = cells[a] + (wrapped[a] ? 0 : 1);
  }
  cells_.reset(cells, wrapped);
  grid_.finest().index.reset(nodes, wrapped);
}

template <int D>
void GridPreconditioner<D>::sort_into_cells(const PoissonSystem& system) {
  const std::size_t n = system.size();
  cell_of_.resize(n);
  place_.resize(n);
  cell_start_.assign(1, 0);
  coordinate_.resize(n);
  const auto count = static_cast<std::int32_t>(n);
  parallel_for(count, 1024, [&](std::int32_t k) {
    const auto i = static_cast<std::size_t>(k);
    for (std::size_t a = 0; a < D; ++a) {
      const std::int32_t extent = cells_.extent()[a];
      const std::int32_t half = extent / 2;
      const double x = (system.x[a][i] - middle_[a]) / width_[a];
      double cell = std::floor(x);
      if (!cells_.wrapped()[a]) cell = std::clamp(cell, -0.5 * extent, 0.5 * extent - 1.0);
      place_[i][a] = static_cast<float>(x - cell);
      double inside = std::fmod(cell + half, extent);
      if (inside < 0.0) inside += extent;
      coordinate_[i][a] = static_cast<std::int32_t>(inside);
    }
  });
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t cell = cells_.add(coordinate_[i]);
    cell_of_[i] = cell;
    if (static_cast<std::size_t>(cell) + 2 > cell_start_.size()) cell_start_.push_back(0);
    ++cell_start_[static_cast<std::size_t>(cell) + 1];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  cell_particle_.resize(n);
  for (std::size_t i = n; i-- > 0;) {
    // Filled from the end of each cell; afterwards the starts have moved down by one entry.
    const auto cell = static_cast<std::size_t>(cell_of_[i]);
    cell_particle_[static_cast<std::size_t>(--cell_start_[cell + 1])] =
        static_cast<std::int32_t>(i);
  }
  std::rotate(cell_start_.begin(), cell_start_.begin() + 1, cell_start_.end());
  cell_start_.back() = static_cast<std::int32_t>(n);
}

template <int D>
void GridPreconditioner<D>::connect_nodes() {
  GridIndex<D>& nodes = grid_.finest().index;
  const std::size_t cells = cells_.points().size();
  cell_node_.resize(cells * corners);
  for (std::size_t k = 0; k < cells; ++k) {
    for (std::size_t q = 0; q < corners; ++q) {
      typename GridIndex<D>::Coordinate c = cells_.points()[k];
      for (std::size_t a = 0; a < D; ++a) c[a] += static_cast<std::int32_t>((q >> a) & 1U);
      cell_node_[k * corners + q] = nodes.add(c);
    }
  }
  node_cell_.assign(nodes.points().size() * corners, -1);
  for (std::size_t k = 0; k < cells; ++k) {
    for (std::size_t q = 0; q < corners; ++q) {
      const auto node = static_cast<std::size_t>(cell_node_[k * corners + q]);
      node_cell_[node * corners + q] = static_cast<std::int32_t>(k);
    }
  }
}

template <int D>
std::array<float, GridPreconditioner<D>::corners> GridPreconditioner<D>::shape(
    std::int32_t particle) const {
  std::array<float, corners> phi;
  const std::array<float, D>& f = place_[static_cast<std::size_t>(particle)];
  for (std::size_t q = 0; q < corners; ++q) {
    phi[q] = 1.0F;
    for (std::size_t a = 0; a < D; ++a) phi[q] *= ((q >> a) & 1U) != 0 ? f[a] : 1.0F - f[a];
  }
  return phi;
}

template <int D>
std::array<std::array<float, D>, GridPreconditioner<D>::corners>
GridPreconditioner<D>::shape_gradient(std::int32_t particle) const {
  std::array<std::array<float, D>, corners> gradient;
  const std::array<float, D>& f = place_[static_cast<std::size_t>(particle)];
  for (std::size_t q = 0; q < corners; ++q) {
    for (std::size_t a = 0; a < D; ++a) {
      const auto slope = static_cast<float>(1.0 / width_[a]);
      float g = ((q >> a) & 1U) != 0 ? slope : -slope;
      for (std::size_t b = 0; b < D; ++b) {
        if (b != a) g *= ((q >> b) & 1U) != 0 ? f[b] : 1.0F - f[b];
      }
      gradient[q][a] = g;
    }
  }
  return gradient;
}

// A pair's share of a slope along an axis is laid to the cells by 6 f (1 - f), f being the place in
// the cell along that axis: its mean is 1, and it vanishes on the faces, so that the operator does
// not jump when a particle goes from cell to cell, or lies on a face to within rounding.
template <int D>
void GridPreconditioner<D>::compute_elements(const PoissonSystem& system, const Field& excess) {
  const auto cells = static_cast<std::int32_t>(cells_.points().size());
  element_.resize(cells_.points().size());
  parallel_for(cells, 256, [&](std::int32_t cell) {
    const auto at = static_cast<std::size_t>(cell);
    Element sum{};
    for (std::int32_t k = cell_start_[at]; k < cell_start_[at + 1]; ++k) {
      const std::int32_t particle = cell_particle_[static_cast<std::size_t>(k)];
      const auto i = static_cast<std::size_t>(particle);
      const auto stiffness =
          static_cast<float>(0.5 * system.mean_square * (system.diagonal[i] - excess[i]));
      const auto mass = static_cast<float>(excess[i]);
      const std::array<float, corners> phi = shape(particle);
      const auto gradient = shape_gradient(particle);
      std::array<float, D> share;
      for (std::size_t a = 0; a < D; ++a)
        share[a] = 6.0F * stiffness * place_[i][a] * (1.0F - place_[i][a]);
      for (std::size_t q = 0; q < corners; ++q) {
        for (std::size_t p = q; p < corners; ++p) {
          float product = 0.0F;
          for (std::size_t a = 0; a < D; ++a) product += share[a] * gradient[q][a] * gradient[p][a];
          sum[q * corners + p] += product + mass * phi[q] * phi[p];
        }
      }
    }
    for (std::size_t q = 0; q < corners; ++q) {
      for (std::size_t p = q; p < corners; ++p) {
        element_[at][q * corners + p] = element_[at][p * corners + q] = sum[q * corners + p];
      }
    }
  });
}

template <int D>
void GridPreconditioner<D>::assemble() {
  GridLevel<D>& level = grid_.finest();
  level.allocate();
  constexpr std::size_t stencil = GridLevel<D>::stencil;
  const std::int32_t n = level.size();
  parallel_for(n, 512, [&](std::int32_t node) {
    const auto at = static_cast<std::size_t>(node);
    for (std::size_t q = 0; q < corners; ++q) {
      if (node_cell_[at * corners + q] < 0) continue;
      const auto cell = static_cast<std::size_t>(node_cell_[at * corners + q]);
      level.diagonal[at] += element_[cell][q * corners + q];
      for (std::size_t p = 0; p < corners; ++p) {
        if (p == q) continue;
        std::size_t s = 0;
        for (std::size_t a = D; a-- > 0;) s = s * 3 + 1 + ((p >> a) & 1U) - ((q >> a) & 1U);
        level.value[at * stencil + s] += element_[cell][q * corners + p];
        level.neighbour[at * stencil + s] = cell_node_[cell * corners + p];
      }
    }
  });
}

template <int D>
void GridPreconditioner<D>::restrict_to_grid(const Field& r) {
  const auto cells = static_cast<std::int32_t>(cells_.points().size());
  cell_rhs_.resize(cells_.points().size() * corners);
  parallel_for(cells, 1000, [&](std::int32_t cell) {
    const auto at = static_cast<std::size_t>(cell);
    std::array<float, corners> sum{};
    for (std::int32_t k = cell_start_[at]; k < cell_start_[at + 1]; ++k) {
      const std::int32_t i = cell_particle_[static_cast<std::size_t>(k)];
      const std::array<float, corners> phi = shape(i);
      const auto value = static_cast<float>(r[static_cast<std::size_t>(i)]);
      for (std::size_t q = 0; q < corners; ++q) sum[q] += phi[q] * value;
    }
    std::copy(sum.begin(), sum.end(), &cell_rhs_[at * corners]);
  });
  GridLevel<D>& level = grid_.finest();
  const std::int32_t n = level.size();
  parallel_for(n, 1000, [&](std::int32_t node) {
    float sum = 0.0F;
    for (std::size_t q = 0; q < corners; ++q) {
      const std::int32_t cell = node_cell_[static_cast<std::size_t>(node) * corners + q];
      if (cell >= 0) sum += cell_rhs_[static_cast<std::size_t>(cell) * corners + q];
    }
    level.rhs[static_cast<std::size_t>(node)] = sum;
  });
}

template <int D>
double GridPreconditioner<D>::apply(const Field& r, Field& z) {
  restrict_to_grid(r);
  grid_.cycle();
  const float* solution = grid_.finest().solution.data();
  return block_sum_(r.size(), [&](std::size_t begin, std::size_t end) {
    double product = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<float, corners> phi = shape(static_cast<std::int32_t>(i));
      const std::int32_t* node = &cell_node_[static_cast<std::size_t>(cell_of_[i]) * corners];
      float sum = 0.0F;
      for (std::size_t q = 0; q < corners; ++q) sum += phi[q] * solution[node[q]];
      z[i] = r[i] * inverse_diagonal_[i] + grid_weight * static_cast<double>(sum);
      product += r[i] * z[i];
    }
    return product;
  });
}

template class GridPreconditioner<2>;
template class GridPreconditioner<3>;

}  // namespace surge::linear
