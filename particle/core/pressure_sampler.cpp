#include "particle/core/pressure_sampler.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle/core/for_each_cell.hpp"
#include "particle/core/parallel_for.hpp"
#include "particle/core/surface_lattice.hpp"
#include "particle/core/wall_collision.hpp"

namespace surge {
namespace {

/// Below it a place counts as partly dry: gaps at a wall and between stretched particles are less.
constexpr double least_wet = 0.75;

/// A place of whose surroundings less than this is open lies between solids: no water presses
/// there.
constexpr double least_open = 0.02;

bool has_surface_near(const Case& c, const Point& x, double reach) {
  return std::any_of(c.obstacles.begin(), c.obstacles.end(), [&](const Obstacle& obstacle) {
    return obstacle.surface && obstacle.surface->distance(x) < reach;
  });
}

struct NoWalls {
  template <std::size_t N>
  [[nodiscard]] bool is_solid(const std::array<double, N>&) const {
    return false;
  }
};

}  // namespace

template <int D>
PressureSampler<D>::PressureSampler(const Case& c, std::vector<Vec<D>> points)
    : radius_(2.0 * c.spacing),
      points_(std::move(points)),
      sum_(points_.size()),
      weights_(points_.size()),
      pressure_(points_.size()) {
  for (std::size_t a = 0; a < D; ++a) {
    const bool wraps = c.has_tank && c.tank.periodic[a];
    period_[a] = wraps ? c.tank.box.upper[a] - c.tank.box.lower[a] : 0.0;
  }
  const WallCollision<D> walls(c, 0.0, 0.0);
  const double all = weight_of_the_open(NoWalls{}, c.spacing, Vec<D>{});
  wet_.resize(points_.size());
  const auto count = static_cast<std::ptrdiff_t>(points_.size());
  parallel_for_in_turn(count, 16, [&](std::ptrdiff_t k, std::size_t) {
    const auto i = static_cast<std::size_t>(k);
    double open = weight_of_the_open(walls, c.spacing, points_[i]);
    if (has_surface_near(c, point_of<D>(points_[i]), radius_))
      open = std::min(open, weight_of_the_lattice(walls, c, points_[i]));
    wet_[i] = open < least_open * all ? std::numeric_limits<double>::infinity() : least_wet * open;
  });
  sort_points();
}

template <int D>
void PressureSampler<D>::sort_points() {
  if (points_.empty()) return;
  lower_ = upper_ = points_.front();
  for (const Vec<D>& point : points_)
    for (std::size_t a = 0; a < D; ++a) {
      lower_[a] = std::min(lower_[a], point[a]);
      upper_[a] = std::max(upper_[a], point[a]);
    }
  std::size_t count = 1;
  for (std::size_t a = 0; a < D; ++a) {
    lower_[a] -= radius_;
    upper_[a] += radius_;
    cells_[a] = static_cast<int>((upper_[a] - lower_[a]) / radius_) + 1;
    count *= static_cast<std::size_t>(cells_[a]);
  }
  std::vector<std::size_t> cell(points_.size());
  cell_begin_.assign(count + 1, 0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    std::size_t index = 0;
    for (std::size_t a = D; a-- > 0;)
      index = index * static_cast<std::size_t>(cells_[a]) +
              static_cast<std::size_t>((points_[k][a] - lower_[a]) / radius_);
    cell[k] = index;
    ++cell_begin_[index + 1];
  }
  for (std::size_t k = 0; k < count; ++k) cell_begin_[k + 1] += cell_begin_[k];
  std::vector<std::size_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  sorted_.resize(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) sorted_[next[cell[k]]++] = k;
}

template <int D>
double PressureSampler<D>::weight(double r) const {
  return (1.0 - r / radius_) * (1.0 - r / radius_);
}

/// int w dV / l0^D over what is not solid, by midpoints.
template <int D>
template <class Walls>
double PressureSampler<D>::weight_of_the_open(const Walls& walls, double spacing,
                                              const Vec<D>& point) const {
  constexpr int parts = D == 2 ? 40 : 24;  // of a diameter
  const double step = 2.0 * radius_ / parts;
  double sum = 0.0;
  std::array<int, D> end;
  end.fill(parts);
  for_each_cell<D>({}, end, [&](const std::array<int, D>& k) {
    Vec<D> x;
    double square = 0.0;
    for (std::size_t a = 0; a < D; ++a) {
      const double d = (k[a] + 0.5) * step - radius_;
      x[a] = point[a] + d;
      square += d * d;
    }
    if (square < radius_ * radius_ && !walls.is_solid(x)) sum += weight(std::sqrt(square));
  });
  return sum * std::pow(step / spacing, D);
}

/// sum w over the places of the fluid's lattice that are not solid.
template <int D>
template <class Walls>
double PressureSampler<D>::weight_of_the_lattice(const Walls& walls, const Case& c,
                                                 const Vec<D>& point) const {
  const Point origin = SurfaceLattice(c, Box{}).origin;
  Vec<D> first;
  std::array<int, D> end;
  for (std::size_t a = 0; a < D; ++a) {
    first[a] = std::floor((point[a] - radius_ - origin[a]) / c.spacing);
    end[a] = static_cast<int>(2.0 * radius_ / c.spacing) + 2;
  }
  double sum = 0.0;
  for_each_cell<D>({}, end, [&](const std::array<int, D>& k) {
    Vec<D> x;
    double square = 0.0;
    for (std::size_t a = 0; a < D; ++a) {
      x[a] = origin[a] + (first[a] + k[a] + 0.5) * c.spacing;
      square += (x[a] - point[a]) * (x[a] - point[a]);
    }
    if (square < radius_ * radius_ && !is_filled(c, point_of<D>(x)) && !walls.is_solid(x))
      sum += weight(std::sqrt(square));
  });
  return sum;
}

template <int D>
template <class F>
void PressureSampler<D>::for_each_image(const Vec<D>& x, F&& f) const {
  std::array<int, D> first{};
  std::array<int, D> last{};
  for (std::size_t a = 0; a < D; ++a) {
    last[a] = 1;
    if (period_[a] == 0.0) continue;
    first[a] = -1;
    last[a] = 2;
  }
  for_each_cell<D>(first, last, [&](const std::array<int, D>& k) {
    Vec<D> image = x;
    for (std::size_t a = 0; a < D; ++a) {
      image[a] += k[a] * period_[a];
      if (image[a] < lower_[a] || image[a] > upper_[a]) return;
    }
    f(image);
  });
}

template <int D>
void PressureSampler<D>::add(const Vec<D>& x, double pressure) {
  std::array<int, D> first;
  std::array<int, D> last;
  for (std::size_t a = 0; a < D; ++a) {
    const int own = static_cast<int>((x[a] - lower_[a]) / radius_);
    first[a] = std::max(own - 1, 0);
    last[a] = std::min(own + 2, cells_[a]);
  }
  for_each_cell<D>(first, last, [&](const std::array<int, D>& k) {
    std::size_t cell = 0;
    for (std::size_t a = D; a-- > 0;)
      cell = cell * static_cast<std::size_t>(cells_[a]) + static_cast<std::size_t>(k[a]);
    for (std::size_t s = cell_begin_[cell]; s < cell_begin_[cell + 1]; ++s) {
      const std::size_t point = sorted_[s];
      double square = 0.0;
      for (std::size_t a = 0; a < D; ++a)
        square += (x[a] - points_[point][a]) * (x[a] - points_[point][a]);
      if (square >= radius_ * radius_) continue;
      const double w = weight(std::sqrt(square));
      sum_[point] += w * pressure;
      weights_[point] += w;
    }
  });
}

template <int D>
const std::vector<double>& PressureSampler<D>::measure(const Particles<D>& particles,
                                                       const Vec<D>& shift) {
  if (points_.empty()) return pressure_;
  std::fill(sum_.begin(), sum_.end(), 0.0);
  std::fill(weights_.begin(), weights_.end(), 0.0);
  // Threads look who is near, each in a stretch of its own; the sums are made in the order of the
  // particles, whatever the number of threads.
  near_.resize(static_cast<std::size_t>(omp_get_max_threads()));
  for (auto& near : near_) near.clear();
  const auto n = static_cast<std::ptrdiff_t>(particles.size());
  const auto look = [&](std::ptrdiff_t k, std::vector<Near>& near) {
    const auto i = static_cast<std::size_t>(k);
    if (particles.type[i] != ParticleType::fluid) return;
    Vec<D> x = particles.position(i);
    for (std::size_t a = 0; a < D; ++a) x[a] -= shift[a];
    for_each_image(x, [&](const Vec<D>& image) { near.push_back({image, particles.pressure[i]}); });
  };
  if (is_shared(n, worth_sharing)) {
#pragma omp parallel
    {
      auto& near = near_[static_cast<std::size_t>(omp_get_thread_num())];
#pragma omp for schedule(static)
      for (std::ptrdiff_t k = 0; k < n; ++k) look(k, near);
    }
  } else {
    for (std::ptrdiff_t k = 0; k < n; ++k) look(k, near_.front());
  }
  for (const auto& near : near_)
    for (const Near& one : near) add(one.x, one.pressure);
  for (std::size_t k = 0; k < points_.size(); ++k)
    pressure_[k] = weights_[k] > 0.0 ? sum_[k] / std::max(weights_[k], wet_[k]) : 0.0;
  return pressure_;
}

template class PressureSampler<2>;
template class PressureSampler<3>;

}  // namespace surge
