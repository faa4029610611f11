#pragma once

#include "particle/core/cell_grid.hpp"
#include "particle/core/particles.hpp"
#include "particle/sph/model.hpp"

namespace surge::sph {

/// What the terms of a step read.
template <int D>
struct View {
  const Model<D>& model;
  const CellGrid<D>& grid;
  const Particles<D>& p;                           ///< in the grid's order
  const Field& fluid_volume;                       ///< m/rho of fluid particles, 0 for walls
  const std::vector<std::uint32_t>& fluid_before;  ///< number of fluid particles before each index

  [[nodiscard]] bool is_fluid(std::size_t i) const { return p.type[i] == ParticleType::fluid; }
  /// Whether there is fluid among [begin, end).
  [[nodiscard]] bool any_fluid(std::size_t begin, std::size_t end) const {
    return fluid_before[end] > fluid_before[begin];
  }
  /// Whether there is fluid in a cell or next to it.
  [[nodiscard]] bool near_fluid(std::size_t cell) const {
    bool found = false;
    grid.for_each_segment(cell, [&](const auto& s) { found = found || any_fluid(s.begin, s.end); });
    return found;
  }
};

/// f(i) for the fluid.
template <int D, class F>
void for_each_fluid(const Particles<D>& p, F&& f) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i)
    if (p.type[i] == ParticleType::fluid) f(static_cast<std::size_t>(i));
}

inline constexpr double tiny = 1e-30;  ///< m^2, keeps 1/r finite for a particle and itself

}  // namespace surge::sph
