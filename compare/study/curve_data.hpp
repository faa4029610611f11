#pragma once

#include "compare/reference/reference_series.hpp"
#include "compare/study/curve_measures.hpp"

namespace surge::compare {

/// A run's curve and a series, whose times are shifted already, in a window.
struct DataInWindow {
  const Curve& run;
  const Curve& series;
  const ReferenceCurve& data;
  double begin = 0.0, end = 0.0;
  const CurveOptions& options;
};

/// Standard uncertainty of a measure of published data, from the 95 % limits l of its values and
/// l_t of its times, each over `coverage`:
///   rms        root of the mean over the points of l^2 + (q' l_t)^2, q' the slope of the run
///   arrival    sqrt(l_t^2 + (l/q')^2), q' the slope of the series there
///   peak-time, phase   l_t
///   impulse    largest l times the window, as if the values' errors went together
///   others     largest l
[[nodiscard]] double data_uncertainty(CurveMeasure measure, const DataInWindow& data);

/// Because a curve is known at its points only: it may pass its straight line by dt^2/8 |q''| with
/// q'' from three points, and a time may lie anywhere between two; half widths of uniform
/// distributions. Root of the mean square over the points of a curve cut to its window.
[[nodiscard]] double sampling_uncertainty(CurveMeasure measure, const Curve& curve);

}  // namespace surge::compare
