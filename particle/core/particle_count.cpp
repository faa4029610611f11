#include "particle/core/particle_count.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace surge {

namespace {

constexpr double most_rows = 1e6;  // of a ball, which takes milliseconds

using Counts = std::array<double, 3>;

/// Particles along each edge of a box; 1 along an axis that the case has not.
Counts counts_of(const Case& c, const Box& box) {
  Counts n{1.0, 1.0, 1.0};
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
    n[a] = std::round((box.upper[a] - box.lower[a]) / c.spacing);
  return n;
}

double product(const Counts& n) {
  return n[0] * n[1] * n[2];
}

/// Particles of a row of n, all of whose centres but that along the row lie at a distance of the
/// middle whose square is `rest`, in radii, that are inside the ball.
double in_row(double n, double rest) {
  if (rest >= 1.0) return 0.0;
  const auto inside = [&](double k) {
    const double offset = (2.0 * k + 1.0) / n - 1.0;
    return offset * offset + rest < 1.0;
  };
  double first = std::clamp(std::floor(0.5 * n * (1.0 - std::sqrt(1.0 - rest))) - 1.0, 0.0, n);
  while (first < n && !inside(first)) ++first;
  return std::max(n - 2.0 * first, 0.0);
}

double count_ball(const Counts& n, int dimension) {
  const double rows = n[1] * n[2];
  if (rows > most_rows)
    return std::round(product(n) * std::numbers::pi / (dimension == 2 ? 4.0 : 6.0));
  double count = 0.0;
  for (double j = 0.0; j < n[1]; ++j) {
    const double y = (2.0 * j + 1.0) / n[1] - 1.0;
    for (double k = 0.0; k < n[2]; ++k) {
      const double z = dimension == 3 ? (2.0 * k + 1.0) / n[2] - 1.0 : 0.0;
      count += in_row(n[0], y * y + z * z);
    }
  }
  return count;
}

/// The layers outside the tank's walls: open and periodic sides have none.
double count_tank(const Case& c, int layers) {
  const Counts n = counts_of(c, c.tank.box);
  Counts outer = n;
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a) {
    if (c.tank.periodic[a]) continue;
    for (const std::size_t side : {2 * a, 2 * a + 1})
      if (!c.tank.open[side]) outer[a] += layers;
  }
  return product(outer) - product(n);
}

/// The outer layers of an obstacle; what lies deeper inside is hollow.
double count_obstacle(const Case& c, const Box& box, int layers) {
  const Counts n = counts_of(c, box);
  Counts hollow = n;
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
    hollow[a] = std::max(n[a] - 2.0 * layers, 0.0);
  return product(n) - product(hollow);
}

}  // namespace

ParticleCount count_particles(const Case& c, int wall_layers) {
  ParticleCount count;
  for (const FluidBlock& block : c.blocks) {
    const Counts n = counts_of(c, block.box);
    count.fluid += block.shape == FluidBlock::Shape::ball ? count_ball(n, c.dimension) : product(n);
  }
  if (c.has_tank) count.wall += count_tank(c, wall_layers);
  for (const Box& box : c.obstacles) count.wall += count_obstacle(c, box, wall_layers);
  for (const MovingWall& wall : c.moving_walls)
    count.wall += count_obstacle(c, wall.box, wall_layers);
  return count;
}

}  // namespace surge
