#include "particle/io/surface_forces.hpp"

#include <algorithm>
#include <cmath>

#include "particle/core/for_each_cell.hpp"
#include "particle/core/wall_collision.hpp"

namespace surge {
namespace {

template <int D>
struct Patches {
  std::vector<Vec<D>> middle;  ///< m
  std::vector<Vec<D>> area;    ///< n A
};

/// Covers the face of a box across `axis`; `sign`: on which side of the box, and where n points to
/// where the solid is the box itself.
template <int D>
void cover(const Box& box, std::size_t axis, bool upper, double sign, double spacing,
           Patches<D>& patches) {
  std::array<int, D> count;
  Vec<D> size;
  double area = 1.0;
  for (std::size_t a = 0; a < D; ++a) {
    const double length = box.upper[a] - box.lower[a];
    count[a] = a == axis ? 1 : std::max(1, static_cast<int>(std::lround(length / spacing)));
    size[a] = length / count[a];
    if (a != axis) area *= size[a];
  }
  for_each_cell<D>({}, count, [&](const std::array<int, D>& k) {
    Vec<D> middle;
    Vec<D> normal{};
    for (std::size_t a = 0; a < D; ++a) middle[a] = box.lower[a] + (k[a] + 0.5) * size[a];
    middle[axis] = upper ? box.upper[axis] : box.lower[axis];
    normal[axis] = sign * area;
    patches.middle.push_back(middle);
    patches.area.push_back(normal);
  });
}

/// All faces of a body that water can be on.
template <int D>
Patches<D> around(const Case& c, const Box& box) {
  Patches<D> patches;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const bool ends = c.has_tank && !c.tank.periodic[axis];
    if (!ends || box.lower[axis] > c.tank.box.lower[axis])
      cover<D>(box, axis, false, -1.0, c.spacing, patches);
    if (!ends || box.upper[axis] < c.tank.box.upper[axis])
      cover<D>(box, axis, true, 1.0, c.spacing, patches);
  }
  return patches;
}

template <int D>
Patches<D> patches_of(const Case& c, const ForceSurface& force) {
  if (force.of == ForceSurface::Of::obstacle) return around<D>(c, c.obstacles[force.index]);
  if (force.of == ForceSurface::Of::moving_wall)
    return around<D>(c, c.moving_walls[force.index].box);
  Patches<D> patches;
  const bool upper = force.index % 2 == 1;
  cover<D>(c.tank.box, force.index / 2, upper, upper ? -1.0 : 1.0, c.spacing, patches);
  return patches;
}

}  // namespace

template <int D>
SurfaceForces<D>::SurfaceForces(const Case& c)
    : walls_(c.moving_walls), force_(c.forces.size(), Point{}) {
  for (const ForceSurface& force : c.forces) {
    Patches<D> patches = patches_of<D>(c, force);
    const bool moves = force.of == ForceSurface::Of::moving_wall;
    surfaces_.push_back({std::move(patches.area), PressureSampler<D>(c, std::move(patches.middle)),
                         moves ? std::optional(force.index) : std::nullopt});
  }
}

template <int D>
const std::vector<Point>& SurfaceForces<D>::measure(const Particles<D>& particles, double time) {
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    Surface& surface = surfaces_[k];
    Vec<D> shift{};
    if (surface.wall) {
      const MovingWall& wall = walls_[*surface.wall];
      const double moved = motion_at(wall.law, time).displacement;
      for (std::size_t a = 0; a < D; ++a) shift[a] = moved * wall.direction[a];
    }
    const std::vector<double>& pressure = surface.sampler.measure(particles, shift);
    force_[k] = {};
    for (std::size_t patch = 0; patch < pressure.size(); ++patch)
      for (std::size_t a = 0; a < D; ++a) force_[k][a] -= pressure[patch] * surface.area[patch][a];
  }
  return force_;
}

template class SurfaceForces<2>;
template class SurfaceForces<3>;

}  // namespace surge
