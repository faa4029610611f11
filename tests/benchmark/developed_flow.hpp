#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "particle/core/particles.hpp"
#include "particle/io/computation.hpp"

namespace surge::benchmarks {

/// The dam break's column in the middle of its collapse, at any resolution and without the hours
/// that a fine column takes to get there. A lattice at rest would flatter every solver: nothing
/// needs sorting, no particles collide and the pressure hardly changes from step to step.
///
/// In three dimensions the tank is as deep as the column is wide.
///
/// Every row of the column is shifted at random by up to 0.2 l0, which breaks the lattice, and
/// moves with the corner flow u = a x, v = -a y, plus up to a twentieth of the top's speed. The top
/// falls with sqrt(g H / 2), about the speed of the real column when the front is at 1.5 widths.
template <int D>
Computation developed_column(const std::string& method, const std::string& preset,
                             std::int64_t fluid_particles) {
  const std::vector<std::string> overrides{"method.name=" + method, "method.preset=" + preset};
  const std::string name = D == 2 ? "dam_break.toml" : "dam_break_3d.toml";
  Computation computation = read_computation(SURGE_SOURCE_DIR "/particle/cases/" + name, overrides);
  Case& c = computation.flow;
  const Box column = c.blocks.at(0).box;
  const double width = column.upper[0] - column.lower[0];
  const double height = column.upper[1] - column.lower[1];
  const auto across =
      std::lround(std::pow(static_cast<double>(fluid_particles) * width / height, 1.0 / D));
  const double l0 = width / static_cast<double>(across);
  const auto rows = std::lround(height / l0);
  const double fall = std::sqrt(0.5 * 9.81 * height);
  const double rate = fall / height;

  c.spacing = l0;
  c.blocks.clear();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (long k = 0; k < rows; ++k) {
    const double left = 0.2 * l0 * (1.0 + any(random));
    const double y = static_cast<double>(k) * l0;
    FluidBlock row;
    row.box = {{left, y, 0.0}, {left + width, y + l0, D == 3 ? width : 0.0}};
    row.velocity = {rate * (left + 0.5 * width) + 0.05 * fall * any(random), -rate * (y + 0.5 * l0),
                    0.0};
    row.velocity_gradient[0][0] = rate;
    row.velocity_gradient[1][1] = -rate;
    c.blocks.push_back(row);
  }
  // A tank that all resolutions divide, and as high as the column: the sheet that goes up the far
  // wall comes later, and walls that no water touches would count as cheap particles.
  const double l0_per_tank = std::round((c.tank.box.upper[0] - c.tank.box.lower[0]) / l0);
  c.tank.box.upper[0] = c.tank.box.lower[0] + l0_per_tank * l0;
  c.tank.box.upper[1] = c.tank.box.lower[1] + static_cast<double>(rows + 4) * l0;
  return computation;
}

/// Ordered pairs (i, j) closer than `radius` (m), i != j, with counts(type of i): what the loops
/// over neighbours have to visit. By its own search, so that it can be trusted as a yardstick.
template <int D, class Counts>
double count_pairs(const Particles<D>& p, double radius, Counts&& counts) {
  std::array<double, D> lower;
  std::array<std::size_t, D> cells;
  std::size_t total = 1;
  for (std::size_t a = 0; a < D; ++a) {
    const auto [low, high] = std::minmax_element(p.x[a].begin(), p.x[a].end());
    lower[a] = *low - radius;
    cells[a] = static_cast<std::size_t>((*high - lower[a]) / radius) + 3;
    total *= cells[a];
  }
  std::vector<std::vector<std::size_t>> members(total);
  const auto cell_at = [&](const std::array<std::size_t, D>& k) {
    std::size_t cell = 0;
    for (std::size_t a = D; a-- > 0;) cell = cell * cells[a] + k[a];
    return cell;
  };
  const auto cell_of = [&](std::size_t i) {
    std::array<std::size_t, D> k;
    for (std::size_t a = 0; a < D; ++a)
      k[a] = static_cast<std::size_t>((p.x[a][i] - lower[a]) / radius);
    return k;
  };
  for (std::size_t i = 0; i < p.size(); ++i) members[cell_at(cell_of(i))].push_back(i);
  double pairs = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!counts(p.type[i])) continue;
    for (int around = 0; around < (D == 2 ? 9 : 27); ++around) {
      std::array<std::size_t, D> k = cell_of(i);
      int rest = around;
      for (std::size_t a = 0; a < D; ++a, rest /= 3)
        k[a] = k[a] + static_cast<std::size_t>(rest % 3) - 1;
      for (const std::size_t j : members[cell_at(k)]) {
        double r2 = 0.0;
        for (std::size_t a = 0; a < D; ++a) r2 += (p.x[a][j] - p.x[a][i]) * (p.x[a][j] - p.x[a][i]);
        if (i != j && r2 < radius * radius) pairs += 1.0;
      }
    }
  }
  return pairs;
}

}  // namespace surge::benchmarks
