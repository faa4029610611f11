#include "foam_cases/acceleration.hpp"

#include <algorithm>
#include <cmath>

#include "particle/case/scales.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

constexpr double most_rows = 500000;
constexpr double rows_in_period = 400.0;
constexpr double rows_in_step = 10.0;  ///< of a ramp, a jump or a sample
constexpr double steps_in_jump = 10.0;

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point scaled(const Point& v, double factor) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

Point sum(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// v turned by -angle about the unit vector e (Rodrigues).
Point turned_back(const Point& v, const Point& e, double angle) {
  const Point across = cross(e, v);
  const double along = dot(e, v) * (1.0 - std::cos(angle));
  return sum(sum(scaled(v, std::cos(angle)), scaled(across, -std::sin(angle))), scaled(e, along));
}

/// The least distance of neighbouring samples.
double sample_interval(const ScalarMotion& law) {
  double least = law.samples.back()[0] - law.samples.front()[0];
  for (std::size_t k = 1; k < law.samples.size(); ++k)
    least = std::min(least, law.samples[k][0] - law.samples[k - 1][0]);
  return least;
}

}  // namespace

AccelerationTable::AccelerationTable(const TankMotion& motion, const Point& gravity, double end,
                                     double longest_step)
    : motion_(motion), gravity_(gravity), spread_(steps_in_jump * longest_step) {
  if (motion_.law.kind == ScalarMotion::Kind::table)
    spread_ = std::max(spread_, sample_interval(motion_.law));
  find_jumps(end);
  step_ = interval(longest_step);
  const double count =
      std::ceil(end / step_) + 3.0;  // the solver looks at the end of its last step
  if (!(count <= most_rows)) {
    throw Error("motion: found a motion that takes " + number_text(count) +
                " rows of accelerations until time.end, expected at most " +
                number_text(most_rows));
  }
  for (double k = 0.0; k < count; ++k) rows_.push_back(row(k * step_));
}

/// What the velocity jumps by, at each time after zero where it does. The integral of a table of
/// accelerations has no jumps.
void AccelerationTable::find_jumps(double end) {
  const ScalarMotion& law = motion_.law;
  std::vector<double> times;
  if (law.kind == ScalarMotion::Kind::harmonic && law.ramp <= 0.0) times = {law.start};
  if (law.kind == ScalarMotion::Kind::constant) times = {law.start, law.stop};
  if (law.kind == ScalarMotion::Kind::table &&
      law.quantity == ScalarMotion::Quantity::displacement) {
    for (const auto& sample : law.samples) times.push_back(sample[0]);
  }
  const double nearby = 1e-9 * end;
  for (const double t : times) {
    if (t <= nearby || t > end) continue;
    const double before = motion_at(law, t - nearby).velocity;
    const double after = motion_at(law, t + nearby).velocity;
    const double size = std::abs(after - before);
    if (size > 1e-6 * std::max(std::abs(before), std::abs(after)))
      jumps_.push_back({t, after - before});
  }
}

double AccelerationTable::interval(double longest_step) const {
  const ScalarMotion& law = motion_.law;
  double step = 10.0 * longest_step;
  if (law.kind == ScalarMotion::Kind::harmonic) {
    step = std::min(step, law.period / rows_in_period);
    if (law.ramp > 0.0) step = std::min(step, law.ramp / rows_in_step);
  }
  if (law.kind == ScalarMotion::Kind::table)
    step = std::min(step, sample_interval(law) / rows_in_step);
  if (!jumps_.empty()) step = std::min(step, spread_ / rows_in_step);
  return step;
}

// The acceleration in the frame of the tank is
//   R^T g - q'' e x r - q'^2 e x (e x r) - 2 q' e x v,  r = x - centre,
// of which OpenFOAM computes the terms in x itself; those of the centre belong to `linear`.
AccelerationRow AccelerationTable::row(double time) const {
  MotionState q = motion_at(motion_.law, time);
  // Its mean over the stretch that a row stands for, so that no rounding moves the impulse.
  const double begin = time - 0.5 * step_, end = time + 0.5 * step_;
  for (const Jump& jump : jumps_) {
    const double shared = std::min(end, jump.time + spread_) - std::max(begin, jump.time);
    q.acceleration += jump.velocity / spread_ * std::max(shared, 0.0) / step_;
  }
  AccelerationRow found;
  found.time = time;
  const Point& e = motion_.direction;
  if (motion_.kind == TankMotion::Kind::translation) {
    found.linear = scaled(e, q.acceleration);
    return found;
  }
  found.omega = scaled(e, q.velocity);
  found.alpha = scaled(e, q.acceleration);
  const Point gravity = turned_back(gravity_, e, q.displacement);
  const Point euler = cross(found.alpha, motion_.centre);
  const Point centripetal = cross(found.omega, cross(found.omega, motion_.centre));
  found.linear = sum(gravity_, scaled(gravity, -1.0));
  found.linear = sum(found.linear, scaled(sum(euler, centripetal), -1.0));
  return found;
}

}  // namespace surge::foam
