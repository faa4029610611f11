#include "particle/case/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace surge {
namespace {

/// 0 before t = 0, 1 after t = length; three times differentiable inside, with zero slope and
/// curvature at both ends: s^3 (10 - 15 s + 6 s^2).
MotionState smooth_ramp(double t, double length) {
  if (length <= 0.0 || t >= length) return {1.0, 0.0, 0.0};
  if (t <= 0.0) return {};
  const double s = t / length;
  return {s * s * s * (10.0 + s * (-15.0 + 6.0 * s)), 30.0 * s * s * (1.0 - s) * (1.0 - s) / length,
          60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (length * length)};
}

MotionState harmonic(const ScalarMotion& m, double time) {
  const double omega = 2.0 * std::numbers::pi / m.period;
  const double t = time - m.start;
  if (t < 0.0) return {};
  const double angle = omega * t + m.phase;
  const MotionState wave{m.amplitude * std::sin(angle), m.amplitude * omega * std::cos(angle),
                         -m.amplitude * omega * omega * std::sin(angle)};
  const MotionState ramp = smooth_ramp(t, m.ramp);
  return {ramp.displacement * wave.displacement,
          ramp.velocity * wave.displacement + ramp.displacement * wave.velocity,
          ramp.acceleration * wave.displacement + 2.0 * ramp.velocity * wave.velocity +
              ramp.displacement * wave.acceleration};
}

MotionState constant(const ScalarMotion& m, double time) {
  if (time < m.start) return {};
  if (time >= m.stop) return {m.speed * (m.stop - m.start), 0.0, 0.0};
  return {m.speed * (time - m.start), m.speed, 0.0};
}

/// Position, slope and curvature of a table of displacements: linear between samples.
MotionState displacement_table(const ScalarMotion& m, double time) {
  const auto& s = m.samples;
  if (time < s.front()[0]) return {s.front()[1], 0.0, 0.0};
  if (time >= s.back()[0]) return {s.back()[1], 0.0, 0.0};
  const auto next =
      std::upper_bound(s.begin(), s.end(), time, [](double t, auto& x) { return t < x[0]; });
  const auto& a = *(next - 1);
  const auto& b = *next;
  const double slope = (b[1] - a[1]) / (b[0] - a[0]);
  return {a[1] + slope * (time - a[0]), slope, 0.0};
}

/// Twice the integral of a table of accelerations, from rest at its first sample; the exact
/// integral of what is linear between samples, zero outside of them.
MotionState acceleration_table(const ScalarMotion& m, double time) {
  MotionState state;
  const auto& s = m.samples;
  if (time < s.front()[0]) return state;
  for (std::size_t k = 0; k + 1 < s.size(); ++k) {
    const double slope = (s[k + 1][1] - s[k][1]) / (s[k + 1][0] - s[k][0]);
    const double h = std::min(time, s[k + 1][0]) - s[k][0];
    state.displacement += state.velocity * h + 0.5 * s[k][1] * h * h + slope * h * h * h / 6.0;
    state.velocity += s[k][1] * h + 0.5 * slope * h * h;
    state.acceleration = s[k][1] + slope * h;
    if (time < s[k + 1][0]) return state;
  }
  state.displacement += state.velocity * (time - s.back()[0]);
  if (time > s.back()[0]) state.acceleration = 0.0;
  return state;
}

}  // namespace

MotionState motion_at(const ScalarMotion& motion, double time) {
  switch (motion.kind) {
    case ScalarMotion::Kind::none:
      return {};
    case ScalarMotion::Kind::harmonic:
      return harmonic(motion, time);
    case ScalarMotion::Kind::constant:
      return constant(motion, time);
    case ScalarMotion::Kind::table:
      if (motion.samples.empty()) return {};
      return motion.quantity == ScalarMotion::Quantity::displacement
                 ? displacement_table(motion, time)
                 : acceleration_table(motion, time);
  }
  return {};
}

}  // namespace surge
