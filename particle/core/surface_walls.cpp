#include "particle/core/surface_walls.hpp"

#include <algorithm>
#include <cmath>

#include "particle/case/vectors.hpp"

namespace surge {
namespace {

/// How far before a facet one looks for what covers it, as a share of the spacing.
constexpr double in_front = 1e-3;
/// Of a spacing: what a path cuts off a corner in less is no wall to it.
constexpr double least_part = 0.02;
constexpr double parts_of_a_path = 32.0;

}  // namespace

bool is_covered(const Case& c, std::size_t number, const Point& x) {
  const auto axes = static_cast<std::size_t>(c.dimension);
  for (std::size_t a = 0; c.has_tank && a < axes; ++a)
    if (!c.tank.periodic[a] && (x[a] < c.tank.box.lower[a] || x[a] > c.tank.box.upper[a]))
      return true;
  for (std::size_t i = 0; i < c.obstacles.size(); ++i) {
    if (i == number) continue;
    bool inside = true;
    for (std::size_t a = 0; a < axes; ++a)
      inside = inside && x[a] > c.obstacles[i].lower[a] && x[a] < c.obstacles[i].upper[a];
    if (inside && (!c.obstacles[i].surface || c.obstacles[i].surface->holds(x))) return true;
  }
  return false;
}

template <int D>
SurfaceWall<D>::SurfaceWall(const Case& c, std::size_t number, double distance)
    : surface_(c.obstacles[number].surface),
      distance_(distance),
      least_step_(least_part * c.spacing) {
  for (std::size_t f = 0; f < surface_->facets().size(); ++f)
    free_.push_back(!is_covered(
        c, number,
        plus(surface_->facet_middle(f), in_front * c.spacing, surface_->facet_normal(f))));
}

template <int D>
bool SurfaceWall<D>::keep_out(const Vec<D>& start, double restitution, Vec<D>& end,
                              Vec<D>& velocity) const {
  const Box& around = surface_->bounds();
  double square = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    if (std::max(start[a], end[a]) < around.lower[a] - distance_ ||
        std::min(start[a], end[a]) > around.upper[a] + distance_)
      return false;
    square += (end[a] - start[a]) * (end[a] - start[a]);
  }
  const double path = std::sqrt(square);
  const Point from = point_of<D>(start), to = point_of<D>(end);
  double before = surface_->distance(from) - distance_;
  if (before >= path && before > 0.0) return false;
  NearestPlace wall;
  if (before >= 0.0) {
    const double least = std::max(least_step_, path / parts_of_a_path);
    double gone = 0.0;
    do {
      gone = std::min(gone + std::max(before, least), path);
      wall = surface_->nearest(plus(from, path > 0.0 ? gone / path : 0.0, minus(to, from)));
      before = wall.distance - distance_;
    } while (before >= 0.0 && gone < path);
    if (before >= 0.0) return false;
    before += dot(minus(to, from), wall.normal) * (path > 0.0 ? 1.0 - gone / path : 0.0);
  } else {  // the path starts inside: out through the surface nearest to its end
    wall = surface_->nearest(to);
    before = wall.distance - distance_;
  }
  if (before >= 0.0) return false;
  double speed = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    end[a] -= (1.0 + restitution) * before * wall.normal[a];
    speed += velocity[a] * wall.normal[a];
  }
  for (std::size_t a = 0; a < D && speed < 0.0; ++a)
    velocity[a] -= (1.0 + restitution) * speed * wall.normal[a];
  return true;
}

template <int D>
bool SurfaceWall<D>::holds(const Vec<D>& x) const {
  return surface_->holds(point_of<D>(x));
}

template <int D>
std::optional<NearestPlace> SurfaceWall<D>::free_place(const Vec<D>& x) const {
  return surface_->nearest_of(point_of<D>(x), free_);
}

template <int D>
std::vector<SurfaceWall<D>> surface_walls(const Case& c, double distance) {
  std::vector<SurfaceWall<D>> walls;
  for (std::size_t i = 0; i < c.obstacles.size(); ++i)
    if (c.obstacles[i].surface) walls.emplace_back(c, i, distance);
  return walls;
}

template class SurfaceWall<2>;
template class SurfaceWall<3>;
template std::vector<SurfaceWall<2>> surface_walls<2>(const Case&, double);
template std::vector<SurfaceWall<3>> surface_walls<3>(const Case&, double);

}  // namespace surge
