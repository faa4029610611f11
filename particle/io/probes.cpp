#include "particle/io/probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/core/for_each_cell.hpp"
#include "particle/core/surface_walls.hpp"

namespace surge {
namespace {

/// The solid face that a place lies nearest to: the axis across it, and the surface that it is of.
struct NearFace {
  std::size_t axis = 0;
  const ClosedSurface* surface = nullptr;
};

template <int D>
NearFace near_face(const Case& c, const Point& place) {
  double least = std::numeric_limits<double>::max();
  std::size_t axis = 0;
  const auto look_at = [&](const Box& box, const std::array<bool, 3>& is_wall) {
    for (std::size_t a = 0; a < D; ++a) {
      if (!is_wall[a]) continue;
      double aside = 0.0;  // from the face's own extent
      for (std::size_t b = 0; b < D; ++b) {
        if (b == a) continue;
        const double past = std::max({box.lower[b] - place[b], place[b] - box.upper[b], 0.0});
        aside = std::hypot(aside, past);
      }
      for (const double face : {box.lower[a], box.upper[a]}) {
        const double distance = std::hypot(place[a] - face, aside);
        if (distance >= least) continue;
        least = distance;
        axis = a;
      }
    }
  };
  if (c.has_tank)
    look_at(c.tank.box, {!c.tank.periodic[0], !c.tank.periodic[1], !c.tank.periodic[2]});
  for (const Obstacle& obstacle : c.obstacles)
    if (!obstacle.surface) look_at(obstacle, {true, true, true});
  for (const MovingWall& wall : c.moving_walls) look_at(wall.box, {true, true, true});
  // A face of a surface lies across the axis that its normal is nearest to.
  const ClosedSurface* surface = nullptr;
  for (const Obstacle& obstacle : c.obstacles) {
    if (!obstacle.surface) continue;
    const NearestPlace near = obstacle.surface->nearest(place);
    if (std::abs(near.distance) >= least) continue;
    least = std::abs(near.distance);
    surface = obstacle.surface.get();
    const Point& n = obstacle.surface->facet_normal(near.facet);
    for (std::size_t a = 0; a < D; ++a)
      if (a == 0 || std::abs(n[a]) > std::abs(n[axis])) axis = a;
  }
  return {axis, surface};
}

/// Places of one probe.
template <int D>
void add_places(const Case& c, const Probe& probe, std::vector<Vec<D>>& places) {
  const double radius = 0.5 * probe.diameter;
  const int half = static_cast<int>(std::ceil(radius / (0.5 * c.spacing)));
  const NearFace face = near_face<D>(c, probe.position);
  const std::size_t normal = face.axis;
  const ClosedSurface* const surface = face.surface;
  std::array<int, D> first;
  std::array<int, D> last;
  first.fill(-half);
  last.fill(half + 1);
  first[normal] = 0;
  last[normal] = 1;
  for_each_cell<D>(first, last, [&](const std::array<int, D>& k) {
    Vec<D> place;
    double square = 0.0;
    bool outside = false;
    for (std::size_t a = 0; a < D; ++a) {
      const double aside = half > 0 ? k[a] * radius / (half + 0.5) : 0.0;
      square += aside * aside;
      place[a] = probe.position[a] + aside;
      if (c.has_tank && !c.tank.periodic[a])
        outside = outside || place[a] < c.tank.box.lower[a] || place[a] > c.tank.box.upper[a];
    }
    // The face of a sensor in an inclined wall is inclined as well.
    if (surface != nullptr && half > 0) {
      const Point on = surface->nearest(point_of<D>(place)).place;
      std::copy_n(on.begin(), D, place.begin());
    }
    if (!outside && square <= radius * radius) places.push_back(place);
  });
}

template <int D>
std::vector<Vec<D>> places_of(const Case& c, std::vector<std::size_t>& first) {
  std::vector<Vec<D>> places;
  for (const Probe& probe : c.probes) {
    first.push_back(places.size());
    add_places<D>(c, probe, places);
  }
  first.push_back(places.size());
  return places;
}

}  // namespace

template <int D>
Probes<D>::Probes(const Case& c)
    : sampler_(c, places_of<D>(c, first_)), pressure_(c.probes.size()) {}

template <int D>
const std::vector<double>& Probes<D>::measure(const Particles<D>& particles) {
  const std::vector<double>& all = sampler_.measure(particles);
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    double sum = 0.0;
    for (std::size_t place = first_[k]; place < first_[k + 1]; ++place) sum += all[place];
    pressure_[k] = sum / static_cast<double>(first_[k + 1] - first_[k]);
  }
  return pressure_;
}

template class Probes<2>;
template class Probes<3>;

}  // namespace surge
