#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/for_each_cell.hpp"
#include "particle/core/particles.hpp"
#include "particle/core/wall_collision.hpp"

namespace surge {

/// Pressure at fixed places, as a sensor with a face of that size would feel it:
///   p = sum_i w_i p_i l0^D / max(sum_i w_i l0^D, wet W),  w_i = (1 - r_i/2l0)^2 for r_i < 2 l0,
/// over the fluid particles, W = int w dV over what is not wall within 2 l0, wet = 3/4. Where water
/// covers the place that is the mean of Shepard (1968), right at walls too. Where it covers less,
/// the rest is dry and counts with p = 0: the first drops on a wall are no load on all of it.
template <int D>
class Probes {
 public:
  explicit Probes(const Case& c) : radius_(2.0 * c.spacing), pressure_(c.probes.size()) {
    for (std::size_t a = 0; a < D; ++a) {
      const bool wraps = c.has_tank && c.tank.periodic[a];
      period_[a] = wraps ? c.tank.box.upper[a] - c.tank.box.lower[a] : 0.0;
    }
    const WallCollision<D> walls(c, 0.0, 0.0);
    for (const Probe& probe : c.probes) {
      points_.push_back(probe.position);
      wet_.push_back(least_wet * weight_of_the_open(walls, c.spacing, probe.position));
    }
  }

  /// Pa, in the order of the case's probes.
  const std::vector<double>& measure(const Particles<D>& particles) {
    for (std::size_t k = 0; k < points_.size(); ++k)
      pressure_[k] = pressure_at(particles, points_[k], wet_[k]);
    return pressure_;
  }

 private:
  /// Below it a place counts as partly dry: gaps at a wall and between stretched particles are
  /// less.
  static constexpr double least_wet = 0.75;

  [[nodiscard]] double weight(double r) const { return std::pow(1.0 - r / radius_, 2); }

  /// int w dV / l0^D over what is neither wall nor obstacle, by midpoints.
  [[nodiscard]] double weight_of_the_open(const WallCollision<D>& walls, double spacing,
                                          const Point& point) const {
    constexpr int parts = 40;  // of a diameter
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

  [[nodiscard]] double pressure_at(const Particles<D>& particles, const Point& point,
                                   double wet) const {
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (particles.type[i] != ParticleType::fluid) continue;
      double square = 0.0;
      for (std::size_t a = 0; a < D; ++a) {
        double d = particles.x[a][i] - point[a];
        if (period_[a] > 0.0) d -= period_[a] * std::round(d / period_[a]);
        square += d * d;
      }
      if (square >= radius_ * radius_) continue;
      const double w = weight(std::sqrt(square));
      sum += w * particles.pressure[i];
      weights += w;
    }
    return weights > 0.0 ? sum / std::max(weights, wet) : 0.0;
  }

  double radius_;                   ///< m
  std::array<double, D> period_{};  ///< m; zero for an axis that is not periodic
  std::vector<Point> points_;
  std::vector<double> wet_;  ///< sum of weights from which on a place is covered by water
  std::vector<double> pressure_;
};

}  // namespace surge
