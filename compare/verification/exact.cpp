#include "compare/verification/exact.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

constexpr double pi = std::numbers::pi;

using DropState = std::array<double, 3>;  // a, b, sigma/A; time in 1/A

DropState drop_rate(const DropState& s) {
  const double a2 = s[0] * s[0];
  const double b2 = s[1] * s[1];
  return {-s[2] * s[0], s[2] * s[1], s[2] * s[2] * (a2 - b2) / (a2 + b2)};
}

DropState moved(const DropState& s, double step, const DropState& rate) {
  return {s[0] + step * rate[0], s[1] + step * rate[1], s[2] + step * rate[2]};
}

}  // namespace

DropAxes drop_axes(double rate, double t) {
  constexpr double longest_step = 1e-3;
  const double end = rate * t;
  const auto steps = static_cast<long>(std::ceil(end / longest_step));
  const double dt = steps > 0 ? end / static_cast<double>(steps) : 0.0;
  DropState s{1.0, 1.0, 1.0};
  for (long k = 0; k < steps; ++k) {
    const DropState k1 = drop_rate(s);
    const DropState k2 = drop_rate(moved(s, 0.5 * dt, k1));
    const DropState k3 = drop_rate(moved(s, 0.5 * dt, k2));
    const DropState k4 = drop_rate(moved(s, dt, k3));
    for (std::size_t i = 0; i < s.size(); ++i)
      s[i] += dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  return {s[0], s[1]};
}

double wave_frequency(double g, double k, double depth) {
  return std::sqrt(g * k * std::tanh(k * depth));
}

double wave_decay(double nu, double k) {
  return 2.0 * nu * k * k;
}

double channel_speed(double force, double nu, double width, double y, double t) {
  constexpr int terms = 199;
  double u = 0.5 * force / nu * y * (width - y);
  for (int m = 1; m <= terms; m += 2) {
    const double q = m * pi / width;
    u -= 4.0 * force / (nu * width * q * q * q) * std::sin(q * y) * std::exp(-q * q * nu * t);
  }
  return u;
}

double patch_spreading() {
  constexpr int terms = 199;
  double sum = 0.0;
  for (int m = 1; m <= terms; m += 2)
    for (int n = 1; n <= terms; n += 2)
      sum += 64.0 / (std::pow(pi, 6) * m * m * n * n * (m * m + n * n));
  // Over 2 I0, I0 = L^4/6; the rigid rotation itself gives 1.
  return 1.0 - 4.0 * 2.0 * sum / (2.0 / 6.0);
}

namespace {

/// The best amplitude and phase for given omega and decay, and what they leave.
struct Trial {
  DampedWave wave;
  double residual = 0.0;
};

Trial best_amplitude(const std::vector<double>& t, const std::vector<double>& y, double omega,
                     double decay) {
  double ss = 0.0, sc = 0.0, cc = 0.0, ys = 0.0, yc = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double e = std::exp(-decay * t[i]);
    const double s = e * std::sin(omega * t[i]);
    const double c = e * std::cos(omega * t[i]);
    ss += s * s, sc += s * c, cc += c * c, ys += y[i] * s, yc += y[i] * c, yy += y[i] * y[i];
  }
  const double determinant = ss * cc - sc * sc;
  const double a = (ys * cc - yc * sc) / determinant;
  const double b = (yc * ss - ys * sc) / determinant;
  return {{omega, decay, std::hypot(a, b), std::atan2(b, a)}, yy - a * ys - b * yc};
}

}  // namespace

DampedWave fit_damped_wave(const std::vector<double>& t, const std::vector<double>& y,
                           double omega) {
  if (t.size() < 8 || t.size() != y.size())
    throw Error("wave: found " + std::to_string(t.size()) + " samples, expected at least 8");
  // Pattern search: amplitude and phase follow from the other two, whose valley is wide.
  Trial best = best_amplitude(t, y, omega, 0.0);
  double step = 0.05 * omega;
  while (step > 1e-8 * omega) {
    Trial next = best;
    for (const auto& [d_omega, d_decay] :
         {std::array{step, 0.0}, {-step, 0.0}, {0.0, step}, {0.0, -step}}) {
      const Trial trial =
          best_amplitude(t, y, best.wave.omega + d_omega, best.wave.decay + d_decay);
      if (trial.residual < next.residual) next = trial;
    }
    if (next.residual < best.residual)
      best = next;
    else
      step *= 0.5;
  }
  return best.wave;
}

}  // namespace surge::compare
