#include "particle/core/particle_count.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "particle/core/surface_lattice.hpp"

namespace surge {

namespace {

constexpr double most_rows = 1e6;    // of a ball, which takes milliseconds
constexpr double most_places = 1e6;  // around a surface, which takes a second

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

Point centre_of(const Case& c, const Box& box, const Counts& k) {
  Point x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
    x[a] = box.lower[a] + (k[a] + 0.5) * c.spacing;
  return x;
}

bool inside_ball_at(const Case& c, const Box& box, const Point& x) {
  double sum = 0.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a) {
    const double size = box.upper[a] - box.lower[a];
    sum += std::pow((2.0 * x[a] - box.lower[a] - box.upper[a]) / size, 2);
  }
  return sum < 1.0;
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

/// The layers inside a surface: one by one, or where they are too many by its area, or volume.
double count_surface(const Case& c, std::size_t number, int layers) {
  const Obstacle& obstacle = c.obstacles[number];
  if (SurfaceLattice(c, obstacle).cells() > most_places) {
    const double depth = layers * c.spacing;
    return std::round(std::min(obstacle.surface->volume(), obstacle.surface->area() * depth) /
                      std::pow(c.spacing, c.dimension));
  }
  double count = 0.0;
  const auto add = [&](const Point&, int) { count += 1.0; };
  if (c.dimension == 2)
    for_each_in_surface<2>(c, number, layers, add);
  else
    for_each_in_surface<3>(c, number, layers, add);
  return count;
}

/// Particles of a block that surfaces leave no place for. One by one, or by the volume.
double count_cut_out(const Case& c, const FluidBlock& block) {
  double count = 0.0;
  for (std::size_t number = 0; number < c.obstacles.size(); ++number) {
    const Obstacle& obstacle = c.obstacles[number];
    if (!obstacle.surface) continue;
    Counts first{}, end{1.0, 1.0, 1.0};
    Box shared{};
    double places = 1.0;
    const double reach = on_surface * c.spacing;
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a) {
      const double from = block.box.lower[a], n = counts_of(c, block.box)[a];
      first[a] = std::max(std::floor((obstacle.lower[a] - reach - from) / c.spacing), 0.0);
      end[a] = std::min(std::ceil((obstacle.upper[a] + reach - from) / c.spacing), n);
      places *= std::max(end[a] - first[a], 0.0);
      shared.lower[a] = from + first[a] * c.spacing;
      shared.upper[a] = from + end[a] * c.spacing;
    }
    if (places > most_places) {
      count += std::round(places * obstacle.surface->share_of(shared));
      continue;
    }
    for (double k = first[2]; k < end[2]; ++k)
      for (double j = first[1]; j < end[1]; ++j)
        for (double i = first[0]; i < end[0]; ++i) {
          const Point x = centre_of(c, block.box, {i, j, k});
          const bool in = block.shape == FluidBlock::Shape::box || inside_ball_at(c, block.box, x);
          if (in && filled_by(c, x) == number) count += 1.0;
        }
  }
  return count;
}

}  // namespace

ParticleCount count_particles(const Case& c, int wall_layers) {
  ParticleCount count;
  for (const FluidBlock& block : c.blocks) {
    const Counts n = counts_of(c, block.box);
    count.fluid += block.shape == FluidBlock::Shape::ball ? count_ball(n, c.dimension) : product(n);
    count.fluid -= count_cut_out(c, block);
  }
  if (c.has_tank) count.wall += count_tank(c, wall_layers);
  for (std::size_t i = 0; i < c.obstacles.size(); ++i)
    count.wall += c.obstacles[i].surface ? count_surface(c, i, wall_layers)
                                         : count_obstacle(c, c.obstacles[i], wall_layers);
  for (const MovingWall& wall : c.moving_walls)
    count.wall += count_obstacle(c, wall.box, wall_layers);
  return count;
}

}  // namespace surge
