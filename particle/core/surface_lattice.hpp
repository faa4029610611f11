#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "particle/case/case.hpp"
#include "particle/core/for_each_cell.hpp"
#include "particle/support/count.hpp"

namespace surge {

/// A place this close to a surface (in spacings) is solid: what is on it to rounding is, too.
inline constexpr double on_surface = 1e-6;

/// The first of the obstacles with a surface that a lattice place lies in, which has its particle;
/// their number where there is none.
[[nodiscard]] inline std::size_t filled_by(const Case& c, const Point& x) {
  const auto found =
      std::find_if(c.obstacles.begin(), c.obstacles.end(), [&](const Obstacle& obstacle) {
        if (!obstacle.surface) return false;
        const double reach = on_surface * c.spacing;
        for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
          if (x[a] < obstacle.lower[a] - reach || x[a] > obstacle.upper[a] + reach) return false;
        return obstacle.surface->distance(x) <= reach;
      });
  return static_cast<std::size_t>(found - c.obstacles.begin());
}

/// Whether no fluid particle is made at a place, as an obstacle with a surface fills it.
[[nodiscard]] inline bool is_filled(const Case& c, const Point& x) {
  return filled_by(c, x) < c.obstacles.size();
}

/// Layer of wall particles at a depth (m) below a surface: 1 down to one spacing, 2 to two ...
[[nodiscard]] inline int layer_at(double depth, double spacing) {
  return std::max(1, static_cast<int>(std::ceil(depth / spacing - on_surface)));
}

/// First cells and ends of the lattice that surrounds an obstacle with a surface, that of the
/// tank's particles or, without a tank, of the first block's.
struct SurfaceLattice {
  Point origin{};  ///< m
  std::array<double, 3> first{}, end{1.0, 1.0, 1.0};

  SurfaceLattice(const Case& c, const Box& bounds)
      : origin(c.has_tank ? c.tank.box.lower : c.blocks.front().box.lower) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a) {
      first[a] = std::floor((bounds.lower[a] - origin[a]) / c.spacing - on_surface);
      end[a] = std::ceil((bounds.upper[a] - origin[a]) / c.spacing + on_surface);
    }
  }
  [[nodiscard]] double cells() const {
    return (end[0] - first[0]) * (end[1] - first[1]) * (end[2] - first[2]);
  }
};

/// Calls f(place, layer) for the lattice places of an obstacle with a surface, as deep as so many
/// layers of wall particles reach. A place on a face between two obstacles is one of the first.
template <int D, class F>
void for_each_in_surface(const Case& c, std::size_t number, int layers, F&& f) {
  const Obstacle& obstacle = c.obstacles[number];
  const SurfaceLattice lattice(c, obstacle);
  constexpr int most = std::numeric_limits<int>::max() / 2;
  std::array<int, D> count;
  for (std::size_t a = 0; a < D; ++a)
    count[a] = static_cast<int>(
        whole_number(lattice.end[a] - lattice.first[a], "resolution.spacing", most));
  for_each_cell<D>({}, count, [&](const std::array<int, D>& k) {
    Point x{};
    for (std::size_t a = 0; a < D; ++a)
      x[a] = lattice.origin[a] + (lattice.first[a] + k[a] + 0.5) * c.spacing;
    const double distance = obstacle.surface->distance(x);
    if (distance > on_surface * c.spacing) return;
    const int layer = layer_at(-distance, c.spacing);
    if (layer <= layers && filled_by(c, x) == number) f(x, layer);
  });
}

}  // namespace surge
