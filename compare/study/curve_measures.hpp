#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compare/study/observables.hpp"

namespace surge::compare {

/// A quantity over time (s) or over x (m), linear between its points.
struct Curve {
  std::vector<double> first;  ///< increasing
  std::vector<double> value;

  [[nodiscard]] bool empty() const { return first.empty(); }
  /// Empty outside of its points.
  [[nodiscard]] std::optional<double> at(double x) const;
  /// Its points from begin to end, with interpolated ends where it goes beyond them.
  [[nodiscard]] Curve within(double begin, double end) const;
  [[nodiscard]] double integral() const;
};

/// What a measure of a single curve needs besides it.
struct CurveOptions {
  std::optional<double> threshold;  ///< of the value
  std::optional<double> period;     ///< s
};

/// Of a curve that was cut to the window, see docs/studies.md; empty where it has none, as an
/// arrival that does not come. `rms` is of two curves and has no value here.
///   impulse    int q dt, exact for the straight pieces
///   amplitude  A = sqrt(a^2 + b^2) of the least-squares fit c + a cos w t + b sin w t, w = 2 pi/P,
///              weighted by the time that a point stands for, over one period at least
///   phase      t of the crest, atan2(b, a) / w
[[nodiscard]] std::optional<double> curve_value(CurveMeasure measure, const Curve& curve,
                                                const CurveOptions& options);

/// d = a - b over the part that both know.
struct CurveDifference {
  double begin = 0.0, end = 0.0;
  double rms = 0.0;      ///< sqrt(1/|W| int d^2)
  double maximum = 0.0;  ///< of |d|
  double bias = 0.0;     ///< 1/|W| int d
};
/// Exact for curves of straight pieces: on the union of both points. Empty where they share no
/// interval.
[[nodiscard]] std::optional<CurveDifference> curve_difference(const Curve& a, const Curve& b);

/// At the points of b that a covers, each counting once; empty where these are fewer than two.
struct PointDifference {
  std::size_t points = 0;
  double rms = 0.0, maximum = 0.0, bias = 0.0;
};
[[nodiscard]] std::optional<PointDifference> point_difference(const Curve& a, const Curve& b);

/// A curve and published points of the same quantity.
struct ShiftedPair {
  const Curve* own = nullptr;
  Curve published;
  double scale = 1.0;   ///< by which differences are divided, in the quantity's unit: > 0
  double within = 0.0;  ///< s, how far the points alone may be shifted
};

/// The one shift within +-limit (s), added to the times of all published points, that makes
/// sum (rms/scale)^2 over the pairs least; three quarters at least of the points that unshifted
/// ones share must stay. Pairs that share fewer than two have no say. Found to a thousandth of the
/// limit.
[[nodiscard]] double best_shift(std::span<const ShiftedPair> pairs, double limit);

}  // namespace surge::compare
