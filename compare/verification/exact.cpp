#include "compare/verification/exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

constexpr double pi = std::numbers::pi;

/// The classical Runge-Kutta scheme in steps of at most `longest`.
template <std::size_t N, class Rate>
std::array<double, N> integrated(std::array<double, N> s, double end, double longest,
                                 const Rate& rate) {
  const auto steps = static_cast<long>(std::ceil(end / longest));
  const double dt = steps > 0 ? end / static_cast<double>(steps) : 0.0;
  const auto moved = [](std::array<double, N> from, double step, const std::array<double, N>& by) {
    for (std::size_t i = 0; i < N; ++i) from[i] += step * by[i];
    return from;
  };
  for (long k = 0; k < steps; ++k) {
    const auto k1 = rate(s);
    const auto k2 = rate(moved(s, 0.5 * dt, k1));
    const auto k3 = rate(moved(s, 0.5 * dt, k2));
    const auto k4 = rate(moved(s, dt, k3));
    for (std::size_t i = 0; i < N; ++i)
      s[i] += dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  return s;
}

}  // namespace

DropAxes drop_axes(double rate, double t) {
  using State = std::array<double, 3>;  // a, b, sigma/A; time in 1/A
  const State end = integrated(State{1.0, 1.0, 1.0}, rate * t, 1e-3, [](const State& s) {
    const double a2 = s[0] * s[0], b2 = s[1] * s[1];
    return State{-s[2] * s[0], s[2] * s[1], s[2] * s[2] * (a2 - b2) / (a2 + b2)};
  });
  return {end[0], end[1]};
}

std::array<double, 3> ellipsoid_axes(const std::array<double, 3>& rates, double t) {
  using State = std::array<double, 6>;  // a_i, A_i
  const double fastest =
      std::max({std::abs(rates[0]), std::abs(rates[1]), std::abs(rates[2]), 1e-300});
  const State end = integrated(
      State{1.0, 1.0, 1.0, rates[0], rates[1], rates[2]}, t, 1e-3 / fastest, [](const State& s) {
        double squares = 0.0, curvature = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
          squares += s[3 + i] * s[3 + i];
          curvature += 1.0 / (s[i] * s[i]);
        }
        State rate{};
        for (std::size_t i = 0; i < 3; ++i) {
          rate[i] = s[3 + i] * s[i];
          rate[3 + i] = squares / curvature / (s[i] * s[i]) - s[3 + i] * s[3 + i];
        }
        return rate;
      });
  return {end[0], end[1], end[2]};
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
