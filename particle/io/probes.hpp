#pragma once

#include <cmath>
#include <vector>

#include "particle/core/particles.hpp"
#include "particle/io/case.hpp"

namespace surge {

/// Pressure at fixed places: the mean over fluid particles within 2 l0, weighted by (1 - r/2l0)^2
/// and divided by the sum of weights (Shepard 1968), so that it stays right at walls and free
/// surfaces. Zero where there is no fluid.
template <int D>
class Probes {
 public:
  explicit Probes(const Case& c) : radius_(2.0 * c.spacing), pressure_(c.probes.size()) {
    for (const Probe& probe : c.probes) points_.push_back(probe.position);
    for (std::size_t a = 0; a < D; ++a) {
      const bool wraps = c.has_tank && c.tank.periodic[a];
      period_[a] = wraps ? c.tank.box.upper[a] - c.tank.box.lower[a] : 0.0;
    }
  }

  /// Pa, in the order of the case's probes.
  const std::vector<double>& measure(const Particles<D>& particles) {
    for (std::size_t k = 0; k < points_.size(); ++k)
      pressure_[k] = pressure_at(particles, points_[k]);
    return pressure_;
  }

 private:
  double pressure_at(const Particles<D>& particles, const Point& point) const {
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
      const double weight = std::pow(1.0 - std::sqrt(square) / radius_, 2);
      sum += weight * particles.pressure[i];
      weights += weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
  }

  double radius_;                   ///< m
  std::array<double, D> period_{};  ///< m; zero for an axis that is not periodic
  std::vector<Point> points_;
  std::vector<double> pressure_;
};

}  // namespace surge
