#include "compare/study/curve_data.hpp"

#include <algorithm>
#include <cmath>

#include "compare/study/sequences.hpp"

namespace surge::compare {
namespace {

/// dq/dt at x, over a hundredth of the curve to either side.
double slope_at(const Curve& curve, double x) {
  const double half = 0.01 * (curve.first.back() - curve.first.front());
  const double a = std::max(x - half, curve.first.front());
  const double b = std::min(x + half, curve.first.back());
  const auto before = curve.at(a), after = curve.at(b);
  return before && after && b > a ? (*after - *before) / (b - a) : 0.0;
}

double rms_of_points(const DataInWindow& in) {
  double squares = 0.0, n = 0.0;
  for (std::size_t i = 0; i < in.series.first.size(); ++i) {
    const double x = in.series.first[i];
    if (x < in.begin || x > in.end) continue;
    squares +=
        std::pow(in.data.limit[i], 2) + std::pow(slope_at(in.run, x) * in.data.first_limit, 2);
    n += 1.0;
  }
  return n > 0.0 ? std::sqrt(squares / n) : 0.0;
}

}  // namespace

double data_uncertainty(CurveMeasure measure, const DataInWindow& in) {
  const double largest = *std::max_element(in.data.limit.begin(), in.data.limit.end());
  const double time = in.data.first_limit;
  switch (measure) {
    case CurveMeasure::rms:
      return rms_of_points(in) / coverage;
    case CurveMeasure::arrival: {
      const auto when = curve_value(measure, in.series, in.options);
      const double slope = when ? std::abs(slope_at(in.series, *when)) : 0.0;
      return std::hypot(time, slope > 0.0 ? largest / slope : 0.0) / coverage;
    }
    case CurveMeasure::peak_time:
    case CurveMeasure::phase:
      return time / coverage;
    case CurveMeasure::impulse:
      return largest * (in.end - in.begin) / coverage;
    case CurveMeasure::peak:
    case CurveMeasure::final:
    case CurveMeasure::amplitude:
      return largest / coverage;
  }
  return 0.0;
}

double sampling_uncertainty(CurveMeasure measure, const Curve& curve) {
  const auto n = curve.first.size();
  if (n < 3) return 0.0;
  const double uniform = 1.0 / std::sqrt(3.0);
  const double step = (curve.first.back() - curve.first.front()) / static_cast<double>(n - 1);
  if (measure == CurveMeasure::arrival || measure == CurveMeasure::peak_time)
    return 0.5 * step * uniform;
  double squares = 0.0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double second = curve.value[i + 1] - 2.0 * curve.value[i] + curve.value[i - 1];
    squares += std::pow(second / 8.0 * uniform, 2);
  }
  const double value = std::sqrt(squares / static_cast<double>(n - 2));
  if (measure == CurveMeasure::phase) return 0.0;
  const double window = curve.first.back() - curve.first.front();
  return measure == CurveMeasure::impulse ? value * window : value;
}

}  // namespace surge::compare
