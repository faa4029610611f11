#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "particle/core/particles.hpp"
#include "particle/io/case.hpp"

namespace surge {

/// Whether x lies beyond a wall of the tank or in an obstacle.
template <int D>
bool in_wall(const Case& c, const Point& x) {
  for (std::size_t a = 0; c.has_tank && a < D; ++a) {
    if (c.tank.periodic[a]) continue;
    if (x[a] < c.tank.box.lower[a] && !c.tank.open[2 * a]) return true;
    if (x[a] > c.tank.box.upper[a] && !c.tank.open[2 * a + 1]) return true;
  }
  return std::any_of(c.obstacles.begin(), c.obstacles.end(), [&](const Box& box) {
    for (std::size_t a = 0; a < D; ++a)
      if (x[a] < box.lower[a] || x[a] > box.upper[a]) return false;
    return true;
  });
}

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
    for (const Probe& probe : c.probes) {
      points_.push_back(probe.position);
      wet_.push_back(least_wet * weight_of_the_open(c, probe.position));
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
  [[nodiscard]] double weight_of_the_open(const Case& c, const Point& point) const {
    constexpr int parts = 40;  // of a diameter
    const double step = 2.0 * radius_ / parts;
    double sum = 0.0;
    std::array<int, D> at{};
    while (at[D - 1] < parts) {
      Point x = point;
      double square = 0.0;
      for (std::size_t a = 0; a < D; ++a) {
        const double d = (at[a] + 0.5) * step - radius_;
        x[a] += d;
        square += d * d;
      }
      if (square < radius_ * radius_ && !in_wall<D>(c, x)) sum += weight(std::sqrt(square));
      ++at[0];
      for (std::size_t a = 0; a + 1 < D && at[a] == parts; ++a) {
        at[a] = 0;
        ++at[a + 1];
      }
    }
    return sum * std::pow(step / c.spacing, D);
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
