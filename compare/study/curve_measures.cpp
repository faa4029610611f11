#include "compare/study/curve_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace surge::compare {

std::optional<double> Curve::at(double x) const {
  if (first.empty() || x < first.front() || x > first.back()) return std::nullopt;
  const auto after = std::upper_bound(first.begin(), first.end(), x);
  if (after == first.end()) return value.back();
  const auto i = static_cast<std::size_t>(after - first.begin());
  const double w = (x - first[i - 1]) / (first[i] - first[i - 1]);
  return (1.0 - w) * value[i - 1] + w * value[i];
}

Curve Curve::within(double begin, double end) const {
  Curve out;
  const auto add = [&](double x, double y) {
    if (!out.first.empty() && !(x > out.first.back())) return;
    out.first.push_back(x);
    out.value.push_back(y);
  };
  if (const auto y = at(begin)) add(begin, *y);
  for (std::size_t i = 0; i < first.size(); ++i)
    if (first[i] >= begin && first[i] <= end) add(first[i], value[i]);
  if (const auto y = at(end)) add(end, *y);
  return out;
}

double Curve::integral() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < first.size(); ++i)
    sum += 0.5 * (value[i] + value[i - 1]) * (first[i] - first[i - 1]);
  return sum;
}

namespace {

std::optional<double> arrival(const Curve& curve, double threshold) {
  for (std::size_t i = 1; i < curve.first.size(); ++i) {
    const double a = curve.value[i - 1], b = curve.value[i];
    if (a >= threshold) {
      if (i == 1) return std::nullopt;  // there from the start
    } else if (b >= threshold) {
      const double w = (threshold - a) / (b - a);
      return curve.first[i - 1] + w * (curve.first[i] - curve.first[i - 1]);
    }
  }
  return std::nullopt;
}

/// Mean over the last tenth.
std::optional<double> final_of(const Curve& curve) {
  const double end = curve.first.back(), length = end - curve.first.front();
  if (!(length > 0.0)) return std::nullopt;
  return curve.within(end - 0.1 * length, end).integral() / (0.1 * length);
}

struct Harmonic {
  double amplitude, crest;
};

/// Normal equations of c + a cos + b sin, weights by the trapezoidal rule.
std::optional<Harmonic> harmonic(const Curve& curve, double period) {
  const std::size_t n = curve.first.size();
  if (n < 4 || curve.first.back() - curve.first.front() < period * (1.0 - 1e-9))
    return std::nullopt;
  const double w = 2.0 * std::numbers::pi / period;
  std::array<std::array<double, 4>, 3> m{};
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? curve.first[i] - curve.first[i - 1] : 0.0;
    const double after = i + 1 < n ? curve.first[i + 1] - curve.first[i] : 0.0;
    const double weight = 0.5 * (before + after);
    const std::array<double, 4> row{1.0, std::cos(w * curve.first[i]), std::sin(w * curve.first[i]),
                                    curve.value[i]};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 4; ++k) m[j][k] += weight * row[j] * row[k];
  }
  for (std::size_t j = 0; j < 3; ++j) {  // the matrix is positive definite: no pivoting
    if (!(std::abs(m[j][j]) > 0.0)) return std::nullopt;
    for (std::size_t r = 0; r < 3; ++r) {
      if (r == j) continue;
      const double factor = m[r][j] / m[j][j];
      for (std::size_t k = 0; k < 4; ++k) m[r][k] -= factor * m[j][k];
    }
  }
  const double a = m[1][3] / m[1][1], b = m[2][3] / m[2][2];
  return Harmonic{std::hypot(a, b), std::atan2(b, a) / w};
}

}  // namespace

std::optional<double> curve_value(CurveMeasure measure, const Curve& curve,
                                  const CurveOptions& options) {
  if (curve.first.size() < 2) return std::nullopt;
  const auto largest = std::max_element(curve.value.begin(), curve.value.end());
  switch (measure) {
    case CurveMeasure::rms:
      return std::nullopt;
    case CurveMeasure::arrival:
      return options.threshold ? arrival(curve, *options.threshold) : std::nullopt;
    case CurveMeasure::peak:
      return *largest;
    case CurveMeasure::peak_time:
      return curve.first[static_cast<std::size_t>(largest - curve.value.begin())];
    case CurveMeasure::impulse:
      return curve.integral();
    case CurveMeasure::final:
      return final_of(curve);
    case CurveMeasure::amplitude:
    case CurveMeasure::phase:
      if (!options.period) return std::nullopt;
      if (const auto fit = harmonic(curve, *options.period))
        return measure == CurveMeasure::amplitude ? fit->amplitude : fit->crest;
      return std::nullopt;
  }
  return std::nullopt;
}

std::optional<CurveDifference> curve_difference(const Curve& a, const Curve& b) {
  if (a.empty() || b.empty()) return std::nullopt;
  CurveDifference out;
  out.begin = std::max(a.first.front(), b.first.front());
  out.end = std::min(a.first.back(), b.first.back());
  const double length = out.end - out.begin;
  if (!(length > 0.0)) return std::nullopt;
  const Curve x = a.within(out.begin, out.end), y = b.within(out.begin, out.end);
  std::vector<double> all;
  std::set_union(x.first.begin(), x.first.end(), y.first.begin(), y.first.end(),
                 std::back_inserter(all));
  double squares = 0.0, before = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double d = *x.at(all[i]) - *y.at(all[i]);
    out.maximum = std::max(out.maximum, std::abs(d));
    if (i > 0) {
      const double h = all[i] - all[i - 1];
      squares += h * (before * before + before * d + d * d) / 3.0;
      out.bias += h * (before + d) / 2.0;
    }
    before = d;
  }
  out.rms = std::sqrt(std::max(squares, 0.0) / length);
  out.bias /= length;
  return out;
}

std::optional<PointDifference> point_difference(const Curve& a, const Curve& b) {
  PointDifference out;
  for (std::size_t i = 0; i < b.first.size(); ++i) {
    const auto y = a.at(b.first[i]);
    if (!y) continue;
    const double d = *y - b.value[i];
    ++out.points;
    out.rms += d * d;
    out.bias += d;
    out.maximum = std::max(out.maximum, std::abs(d));
  }
  if (out.points < 2) return std::nullopt;
  out.rms = std::sqrt(out.rms / static_cast<double>(out.points));
  out.bias /= static_cast<double>(out.points);
  return out;
}

double best_shift(std::span<const ShiftedPair> pairs, double limit) {
  struct Term {
    const ShiftedPair* pair;
    std::size_t fewest;
  };
  std::vector<Term> terms;
  double least = 0.0;
  for (const ShiftedPair& pair : pairs) {
    const auto raw = point_difference(*pair.own, pair.published);
    if (!raw) continue;
    terms.push_back({&pair, std::max<std::size_t>(2, (3 * raw->points + 3) / 4)});
    least += std::pow(raw->rms / pair.scale, 2);
  }
  double best = 0.0;
  for (int step = -1000; step <= 1000; ++step) {
    const double shift = 0.001 * step * limit;
    double squares = 0.0;
    for (const Term& term : terms) {
      Curve moved = term.pair->published;
      for (double& t : moved.first) t += shift;
      const auto found = point_difference(*term.pair->own, moved);
      squares += found && found->points >= term.fewest ? std::pow(found->rms / term.pair->scale, 2)
                                                       : std::numeric_limits<double>::infinity();
    }
    if (squares >= least) continue;
    least = squares;
    best = shift;
  }
  return best;
}

}  // namespace surge::compare
