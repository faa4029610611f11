#include "particle/core/initial_particles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "particle/core/for_each_cell.hpp"
#include "particle/core/surface_lattice.hpp"
#include "particle/support/count.hpp"

namespace surge {
namespace {

template <int D>
void append(Particles<D>& p, const Vec<D>& x, const Vec<D>& v, ParticleType type) {
  for (int a = 0; a < D; ++a) {
    p.x[a].push_back(x[a]);
    p.v[a].push_back(v[a]);
  }
  p.type.push_back(type);
  p.id.push_back(static_cast<std::int32_t>(p.id.size()));
  p.pressure.push_back(0.0);
  p.density.push_back(0.0);
}

template <int D>
std::array<int, D> cells_of(const Box& box, double l0) {
  std::array<int, D> n;
  for (int a = 0; a < D; ++a)
    n[a] = static_cast<int>(whole_number((box.upper[a] - box.lower[a]) / l0, "resolution.spacing",
                                         std::numeric_limits<int>::max() / 2));
  return n;
}

template <int D>
Vec<D> cell_centre(const Box& box, const std::array<int, D>& k, double l0) {
  Vec<D> x;
  for (int a = 0; a < D; ++a) x[a] = box.lower[a] + (k[a] + 0.5) * l0;
  return x;
}

/// Velocity (m/s) at time zero of the standing wave eta = A cos k(x - x0) sin omega t on a layer of
/// depth H between frictionless walls at x0 and x0 + pi/k, when its surface is flat: by linear
/// theory (Lamb, Hydrodynamics, Art. 228),
///   u = -A omega sin k(x - x0) cosh k(y - y0) / sinh kH,
///   v =  A omega cos k(x - x0) sinh k(y - y0) / sinh kH,  omega^2 = g k tanh kH.
Point wave_velocity(const FluidBlock& block, double g, const Point& x) {
  const double k = std::numbers::pi / (block.box.upper[0] - block.box.lower[0]);
  const double depth = k * (block.box.upper[1] - block.box.lower[1]);
  const double scale =
      block.wave_amplitude * std::sqrt(g * k * std::tanh(depth)) / std::sinh(depth);
  const double along = k * (x[0] - block.box.lower[0]);
  const double up = k * (x[1] - block.box.lower[1]);
  return {-scale * std::sin(along) * std::cosh(up), scale * std::cos(along) * std::sinh(up), 0.0};
}

bool inside_ball(const Box& box, const Point& x, int dimension) {
  double sum = 0.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    const double radius = 0.5 * (box.upper[a] - box.lower[a]);
    const double offset = (x[a] - 0.5 * (box.lower[a] + box.upper[a])) / radius;
    sum += offset * offset;
  }
  return sum < 1.0;
}

template <int D>
Point as_point(const Vec<D>& x) {
  Point p{};
  std::copy(x.begin(), x.end(), p.begin());
  return p;
}

template <int D>
void add_block(Particles<D>& p, const Case& c, const FluidBlock& block) {
  const double g = length(c.gravity), l0 = c.spacing;
  for_each_cell<D>({}, cells_of<D>(block.box, l0), [&](const std::array<int, D>& k) {
    const Vec<D> x = cell_centre<D>(block.box, k, l0);
    const Point point = as_point<D>(x);
    if (block.shape == FluidBlock::Shape::ball && !inside_ball(block.box, point, D)) return;
    if (is_filled(c, point)) return;
    const Point velocity = initial_velocity(block, point);
    Vec<D> v;
    std::copy_n(velocity.begin(), D, v.begin());
    if (block.wave_amplitude > 0.0) {
      const Point wave = wave_velocity(block, g, point);
      for (int a = 0; a < D; ++a) v[a] += wave[a];
    }
    append<D>(p, x, v, ParticleType::fluid);
  });
}

ParticleType layer_type(int layer) {
  return layer == 1 ? ParticleType::wall : ParticleType::dummy;
}

template <int D>
void add_tank(Particles<D>& p, const Tank& tank, double l0, int layers) {
  const auto n = cells_of<D>(tank.box, l0);
  std::array<int, D> lower;
  std::array<int, D> upper;
  for (int a = 0; a < D; ++a) {
    lower[a] = tank.periodic[a] ? 0 : -layers;
    upper[a] = n[a] - lower[a];
  }
  for_each_cell<D>(lower, upper, [&](const std::array<int, D>& k) {
    int layer = 0;
    for (int a = 0; a < D; ++a) {
      const int below = -k[a];
      const int above = k[a] - n[a] + 1;
      const std::size_t side = 2 * static_cast<std::size_t>(a);
      if ((below > 0 && tank.open[side]) || (above > 0 && tank.open[side + 1])) return;
      layer = std::max({layer, below, above});
    }
    if (layer > 0) append<D>(p, cell_centre<D>(tank.box, k, l0), Vec<D>{}, layer_type(layer));
  });
}

template <int D>
void add_obstacle(Particles<D>& p, const Box& box, double l0, int layers) {
  const auto n = cells_of<D>(box, l0);
  for_each_cell<D>({}, n, [&](const std::array<int, D>& k) {
    int layer = std::numeric_limits<int>::max();
    for (int a = 0; a < D; ++a) layer = std::min({layer, k[a] + 1, n[a] - k[a]});
    if (layer <= layers) append<D>(p, cell_centre<D>(box, k, l0), Vec<D>{}, layer_type(layer));
  });
}

template <int D>
void add_surface(Particles<D>& p, const Case& c, std::size_t number, int layers) {
  for_each_in_surface<D>(c, number, layers, [&](const Point& place, int layer) {
    Vec<D> x;
    std::copy_n(place.begin(), D, x.begin());
    append<D>(p, x, Vec<D>{}, layer_type(layer));
  });
}

}  // namespace

template <int D>
Particles<D> initial_particles(const Case& c, int wall_layers) {
  Particles<D> p;
  for (const FluidBlock& block : c.blocks) add_block<D>(p, c, block);
  if (c.has_tank) add_tank<D>(p, c.tank, c.spacing, wall_layers);
  for (std::size_t i = 0; i < c.obstacles.size(); ++i) {
    if (c.obstacles[i].surface)
      add_surface<D>(p, c, i, wall_layers);
    else
      add_obstacle<D>(p, c.obstacles[i], c.spacing, wall_layers);
  }
  for (const MovingWall& wall : c.moving_walls)
    add_obstacle<D>(p, wall.box, c.spacing, wall_layers);
  return p;
}

template <int D>
std::vector<std::int32_t> moving_wall_ids(const Case& c, int wall_layers, std::size_t particles) {
  std::vector<std::int32_t> end{0};
  Particles<D> walls;
  for (const MovingWall& wall : c.moving_walls) {
    add_obstacle<D>(walls, wall.box, c.spacing, wall_layers);
    end.push_back(static_cast<std::int32_t>(walls.size()));
  }
  const auto before = static_cast<std::int32_t>(particles - walls.size());
  for (std::int32_t& id : end) id += before;
  return end;
}

template <int D>
double initial_depth(const Case& c, const Vec<D>& x, double reach) {
  const Point gravity = still_gravity(c);
  const double g = length(gravity);
  if (g == 0.0) return 0.0;
  double depth = 0.0;
  for (const FluidBlock& block : c.blocks) {
    double outside = 0.0;
    double below_top = 0.0;
    for (int a = 0; a < D; ++a) {
      const double lower = block.box.lower[a];
      const double upper = block.box.upper[a];
      const double gap = std::max({0.0, lower - x[a], x[a] - upper});
      outside += gap * gap;
      const double top = gravity[a] < 0.0 ? upper : lower;
      below_top += gravity[a] / g * (x[a] - top);
    }
    if (outside <= reach * reach) depth = std::max(depth, below_top);
  }
  return depth;
}

template Particles<2> initial_particles<2>(const Case&, int);
template Particles<3> initial_particles<3>(const Case&, int);
template std::vector<std::int32_t> moving_wall_ids<2>(const Case&, int, std::size_t);
template std::vector<std::int32_t> moving_wall_ids<3>(const Case&, int, std::size_t);
template double initial_depth<2>(const Case&, const Vec<2>&, double);
template double initial_depth<3>(const Case&, const Vec<3>&, double);

}  // namespace surge
