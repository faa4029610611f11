#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "particle/case/closed_surface.hpp"

namespace surge::test {

using Triangles = std::pair<std::vector<Point>, std::vector<ClosedSurface::Facet>>;

/// The twelve triangles of a box, facing outwards.
inline Triangles cube_triangles(const Point& lower, const Point& upper) {
  std::vector<Point> vertices;
  for (std::size_t k = 0; k < 8; ++k) {
    Point x = lower;
    for (std::size_t a = 0; a < 3; ++a)
      if ((k >> a & 1U) != 0) x[a] = upper[a];
    vertices.push_back(x);
  }
  return {vertices,
          {{0, 2, 1},
           {1, 2, 3},
           {4, 5, 6},
           {5, 7, 6},
           {0, 1, 4},
           {1, 5, 4},
           {2, 6, 3},
           {3, 6, 7},
           {0, 4, 2},
           {2, 4, 6},
           {1, 3, 5},
           {3, 7, 5}}};
}

inline ClosedSurface cube_surface(const Point& lower, const Point& upper) {
  auto [vertices, facets] = cube_triangles(lower, upper);
  return ClosedSurface::triangles(std::move(vertices), std::move(facets));
}

/// A ball by circles of latitude, `parts` from pole to pole and twice as many corners on each.
inline ClosedSurface ball_surface(const Point& centre, double radius, std::uint32_t parts) {
  std::vector<Point> vertices{{centre[0], centre[1], centre[2] - radius},
                              {centre[0], centre[1], centre[2] + radius}};
  std::vector<ClosedSurface::Facet> facets;
  const std::uint32_t around = 2 * parts;
  const auto at = [&](std::uint32_t ring, std::uint32_t k) {
    return 2 + (ring - 1) * around + k % around;
  };
  for (std::uint32_t ring = 1; ring < parts; ++ring)
    for (std::uint32_t k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * ring / parts;
      const double angle = 2.0 * std::numbers::pi * k / around;
      vertices.push_back({centre[0] + radius * std::sin(polar) * std::cos(angle),
                          centre[1] + radius * std::sin(polar) * std::sin(angle),
                          centre[2] - radius * std::cos(polar)});
    }
  for (std::uint32_t k = 0; k < around; ++k) {
    facets.push_back({0, at(1, k + 1), at(1, k)});
    facets.push_back({1, at(parts - 1, k), at(parts - 1, k + 1)});
    for (std::uint32_t ring = 1; ring + 1 < parts; ++ring) {
      facets.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k)});
      facets.push_back({at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)});
    }
  }
  return ClosedSurface::triangles(std::move(vertices), std::move(facets));
}

}  // namespace surge::test
