#include "particle/core/wall_normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/core/neighbour_list.hpp"
#include "particle/core/surface_lattice.hpp"
#include "particle/core/surface_walls.hpp"

namespace surge {
namespace {

/// From the nearest point of a box to x; zero inside. m
template <int D>
Vec<D> outside_of(const Box& box, const Vec<D>& x) {
  Vec<D> d;
  for (std::size_t a = 0; a < D; ++a) d[a] = x[a] - std::clamp(x[a], box.lower[a], box.upper[a]);
  return d;
}

/// From x in a box to the nearest of its faces, m.
template <int D>
Vec<D> to_nearest_face(const Box& box, const Vec<D>& x) {
  Vec<D> d{};
  double least = std::numeric_limits<double>::max();
  for (std::size_t a = 0; a < D; ++a) {
    for (const double face : {box.lower[a], box.upper[a]}) {
      if (std::abs(face - x[a]) >= least) continue;
      least = std::abs(face - x[a]);
      d = {};
      d[a] = face - x[a];
    }
  }
  return d;
}

/// Unit normal of the free surface that is nearest; zero where all of it is covered.
template <int D>
Vec<D> to_surface(const SurfaceWall<D>& wall, const Vec<D>& x) {
  Vec<D> n{};
  if (const auto place = wall.free_place(x)) std::copy_n(place->normal.begin(), D, n.begin());
  return n;
}

}  // namespace

template <int D>
std::vector<Vec<D>> wall_normals(const Case& c, const Particles<D>& p) {
  std::vector<Box> boxes;
  for (const Obstacle& obstacle : c.obstacles)
    if (!obstacle.surface) boxes.push_back(obstacle);
  const std::vector<SurfaceWall<D>> surfaces = surface_walls<D>(c, 0.0);
  for (const MovingWall& wall : c.moving_walls) boxes.push_back(wall.box);
  std::vector<Vec<D>> normals(p.size(), Vec<D>{});
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] == ParticleType::fluid) continue;
    Vec<D> n{};
    if (c.has_tank) n = outside_of<D>(c.tank.box, p.position(i));
    if (squared_norm<D>(n) == 0.0) {
      for (const Box& box : boxes)
        if (squared_norm<D>(outside_of<D>(box, p.position(i))) == 0.0)
          n = to_nearest_face<D>(box, p.position(i));
      for (const SurfaceWall<D>& wall : surfaces)
        if (wall.surface().distance(point_of<D>(p.position(i))) <= on_surface * c.spacing)
          n = to_surface<D>(wall, p.position(i));
    }
    const double length = std::sqrt(squared_norm<D>(n));
    if (length == 0.0) continue;
    for (int a = 0; a < D; ++a) normals[static_cast<std::size_t>(p.id[i])][a] = n[a] / length;
  }
  return normals;
}

template std::vector<Vec<2>> wall_normals<2>(const Case&, const Particles<2>&);
template std::vector<Vec<3>> wall_normals<3>(const Case&, const Particles<3>&);

}  // namespace surge
