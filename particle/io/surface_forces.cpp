#include "particle/io/surface_forces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "particle/case/vectors.hpp"
#include "particle/core/for_each_cell.hpp"
#include "particle/core/surface_walls.hpp"

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

/// Calls f(middle, share of the facet) for parts of a facet that are about a spacing across.
template <class F>
void for_each_part(const ClosedSurface& surface, std::size_t facet, double spacing, F&& f) {
  const ClosedSurface::Facet& corner = surface.facets()[facet];
  const Point& a = surface.vertices()[corner[0]];
  const Point ab = minus(surface.vertices()[corner[1]], a);
  const double size = surface.facet_size(facet);
  if (surface.dimension() == 2) {
    const double n = std::max(1.0, std::round(size / spacing));
    for (double k = 0.0; k < n; ++k) f(plus(a, (k + 0.5) / n, ab), 1.0 / n);
    return;
  }
  const Point ac = minus(surface.vertices()[corner[2]], a);
  const double n = std::max(1.0, std::round(std::sqrt(2.0 * size) / spacing));
  for (double j = 0.0; j < n; ++j) {
    for (double k = 0.0; j + k < n; ++k) {
      // The small triangle that lies as the facet does, and the one beside it that is turned.
      for (const double third : {1.0 / 3.0, 2.0 / 3.0})
        if (third < 0.5 || j + k + 1.0 < n)
          f(plus(plus(a, (j + third) / n, ab), (k + third) / n, ac), 1.0 / (n * n));
    }
  }
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

/// What of a surface nothing covers, facet by facet. Facets smaller than a spacing that lie in one
/// cell of the lattice and face the same way along the same axis make one patch.
template <int D>
Patches<D> around_surface(const Case& c, std::size_t number) {
  const ClosedSurface& surface = *c.obstacles[number].surface;
  Patches<D> patches;
  struct Small {
    Point moment{}, area{};  ///< sum of A x and of n A
    double size = 0.0;
  };
  std::map<std::array<double, 4>, Small> small;
  const auto add = [&](const Point& middle, const Point& area) {
    Vec<D> x, a;
    std::copy_n(middle.begin(), D, x.begin());
    std::copy_n(area.begin(), D, a.begin());
    patches.middle.push_back(x);
    patches.area.push_back(a);
  };
  for (std::size_t f = 0; f < surface.facets().size(); ++f) {
    const Point& n = surface.facet_normal(f);
    const double size = surface.facet_size(f);
    for_each_part(surface, f, c.spacing, [&](const Point& middle, double share) {
      if (is_covered(c, number, plus(middle, 1e-3 * c.spacing, n))) return;
      if (share < 1.0) return add(middle, plus({}, share * size, n));
      std::array<double, 4> key{};
      for (std::size_t a = 0; a < 3; ++a) {
        key[a] = std::floor(middle[a] / c.spacing);
        if (std::abs(n[a]) > 0.6 && key[3] == 0.0)
          key[3] = (n[a] > 0.0 ? 1.0 : -1.0) * static_cast<double>(a + 1);
      }
      Small& one = small[key];
      one.moment = plus(one.moment, size, middle);
      one.area = plus(one.area, size, n);
      one.size += size;
    });
  }
  for (const auto& [key, one] : small)
    add(surface.nearest(plus({}, 1.0 / one.size, one.moment)).place, one.area);
  return patches;
}

template <int D>
Patches<D> patches_of(const Case& c, const ForceSurface& force) {
  if (force.of == ForceSurface::Of::obstacle)
    return c.obstacles[force.index].surface ? around_surface<D>(c, force.index)
                                            : around<D>(c, c.obstacles[force.index]);
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
