#include "particle/case/scales.hpp"

#include <algorithm>
#include <cmath>

namespace surge {
namespace {

/// Height of a point of the box above the box's lowest point, along -gravity: its extent.
double extent_along(const Box& box, const Point& direction) {
  double sum = 0.0;
  for (std::size_t a = 0; a < 3; ++a) sum += std::abs(direction[a]) * (box.upper[a] - box.lower[a]);
  return sum;
}

}  // namespace

double length(const Point& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

Point initial_velocity(const FluidBlock& block, const Point& x) {
  Point v = block.velocity;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      v[a] +=
          block.velocity_gradient[a][b] * (x[b] - 0.5 * (block.box.lower[b] + block.box.upper[b]));
  return v;
}

Point still_gravity(const Case& c) {
  Point g = c.gravity;
  for (std::size_t a = 0; a < 3; ++a)
    if (c.has_tank && c.tank.periodic[a]) g[a] = 0.0;
  return g;
}

double reference_speed(const Case& c) {
  if (c.reference_speed > 0.0) return c.reference_speed;
  const Point gravity = still_gravity(c);
  const double g = length(gravity);
  double speed = 0.0;
  for (const FluidBlock& block : c.blocks) {
    // The fluid can fall from the top of its block to the tank's floor.
    double height = 0.0;
    if (g > 0.0) {
      const Point down{gravity[0] / g, gravity[1] / g, gravity[2] / g};
      height = extent_along(block.box, down);
      if (c.has_tank) {
        for (std::size_t a = 0; a < 3; ++a) {
          const double drop = down[a] < 0.0 ? block.box.lower[a] - c.tank.box.lower[a]
                                            : c.tank.box.upper[a] - block.box.upper[a];
          height += std::abs(down[a]) * drop;
        }
      }
    }
    speed = std::max(speed, std::sqrt(2.0 * g * height));
    for (int corner = 0; corner < 8; ++corner) {
      Point x;
      for (std::size_t a = 0; a < 3; ++a)
        x[a] = (corner >> a & 1) != 0 ? block.box.upper[a] : block.box.lower[a];
      speed = std::max(speed, length(initial_velocity(block, x)));
    }
  }
  return speed;
}

}  // namespace surge
