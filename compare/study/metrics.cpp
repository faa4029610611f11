#include "compare/study/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

/// First time at which a front comes within the wall's distance; the end of what it knows where it
/// does not.
DimensionlessTime end_of(const DimensionlessFront& front, const WallRule& wall) {
  const DimensionlessTime last = front.samples.back().time;
  const auto limit = wall.limit();
  if (!limit) return last;
  if (front.samples.front().position >= *limit) return front.samples.front().time;
  return front.arrival(*limit).value_or(last);
}

/// Times of both fronts inside the window, with its ends.
std::vector<DimensionlessTime> union_of_times(const DimensionlessFront& a,
                                              const DimensionlessFront& b, const Window& window) {
  std::vector<DimensionlessTime> times{window.begin, window.end};
  for (const DimensionlessFront* front : {&a, &b}) {
    for (const auto& sample : front->samples) {
      if (sample.time > window.begin && sample.time < window.end) times.push_back(sample.time);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

void require_samples(const DimensionlessFront& front) {
  if (front.samples.size() < 2) {
    throw Error("front: " + std::to_string(front.samples.size()) +
                " samples found, at least 2 expected");
  }
}

/// Statistics of d_i at points.
SeriesDifference statistics(const std::vector<double>& d) {
  SeriesDifference result;
  result.points = d.size();
  for (const double value : d) {
    result.rms += value * value;
    result.bias += value;
    result.maximum = std::max(result.maximum, std::abs(value));
  }
  const auto n = static_cast<double>(d.size());
  result.rms = std::sqrt(result.rms / n);
  result.bias /= n;
  return result;
}

}  // namespace

std::optional<DimensionlessLength> WallRule::limit() const {
  if (!far_wall) return std::nullopt;
  return *far_wall - distance;
}

Window common_window(const DimensionlessFront& a, const DimensionlessFront& b,
                     const WallRule& wall) {
  require_samples(a);
  require_samples(b);
  const Window window{std::max(a.samples.front().time, b.samples.front().time),
                      std::min(end_of(a, wall), end_of(b, wall))};
  if (window.end <= window.begin) {
    std::ostringstream line;
    line << "window: T from " << window.begin.value() << " to " << window.end.value()
         << " is common before the far wall, an interval expected";
    throw Error(line.str());
  }
  return window;
}

FrontDifference difference(const DimensionlessFront& run, const DimensionlessFront& reference,
                           const WallRule& wall) {
  FrontDifference result;
  result.window = common_window(run, reference, wall);
  const std::vector<DimensionlessTime> times = union_of_times(run, reference, result.window);
  std::vector<double> d;
  for (const DimensionlessTime t : times) {
    d.push_back((*run.at(t) - *reference.at(t)).value());
    if (std::abs(d.back()) > result.maximum || d.size() == 1) {
      result.maximum = std::abs(d.back());
      result.time_of_maximum = t;
    }
  }
  const double length = (result.window.end - result.window.begin).value();
  double squares = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double h = (times[i] - times[i - 1]).value();
    squares += h * (d[i - 1] * d[i - 1] + d[i - 1] * d[i] + d[i] * d[i]) / 3.0;
    result.bias += h * (d[i - 1] + d[i]) / 2.0;
  }
  result.rms = std::sqrt(squares / length);
  result.bias /= length;
  for (std::size_t k = 0; k < arrival_levels.size(); ++k) {
    const auto a = run.arrival_moment(DimensionlessLength(arrival_levels[k]));
    const auto b = reference.arrival_moment(DimensionlessLength(arrival_levels[k]));
    if (!a || !b) continue;
    result.arrival[k] = a->time - b->time;
    result.arrival_uncertainty[k] = std::hypot(a->uncertainty(), b->uncertainty());
  }
  return result;
}

SeriesComparison against_series(const DimensionlessFront& run, const PublishedSeries& series,
                                const WallRule& wall) {
  require_samples(run);
  const DimensionlessTime begin = run.samples.front().time;
  const DimensionlessTime end = end_of(run, wall);
  const auto differences = [&](DimensionlessTime shift) {
    std::vector<double> d;
    for (const auto& point : series.front.samples) {
      const DimensionlessTime t = point.time + shift;
      if (t >= begin && t <= end) d.push_back((*run.at(t) - point.position).value());
    }
    return d;
  };
  const std::vector<double> raw = differences(DimensionlessTime(0.0));
  if (raw.size() < 2) {
    throw Error("series " + series.name + ": " + std::to_string(raw.size()) +
                " points inside the run's window found, at least 2 expected");
  }
  SeriesComparison result;
  result.raw = statistics(raw);
  result.shifted = result.raw;
  // A shift may bring points in or out; a fit to fewer than the raw ones less a quarter is no fit.
  const std::size_t fewest = std::max<std::size_t>(2, (3 * raw.size() + 3) / 4);
  for (int step = -1000; step <= 1000; ++step) {
    const DimensionlessTime shift(0.001 * step);
    const std::vector<double> d = differences(shift);
    if (d.size() < fewest) continue;
    const SeriesDifference shifted = statistics(d);
    if (shifted.rms < result.shifted.rms) {
      result.shifted = shifted;
      result.shift = shift;
    }
  }
  return result;
}

std::optional<Impact> impact(const FrontHistory& history, Metres far_wall, Metres spacing) {
  const Metres level = far_wall - 0.5 * spacing;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const FrontSample& a = history[i - 1];
    const FrontSample& b = history[i];
    if (a.position >= level) return std::nullopt;  // there from the start
    if (b.position < level) continue;
    const double w = (level - a.position) / (b.position - a.position);
    return Impact{(1.0 - w) * a.time + w * b.time, a.time, b.time};
  }
  return std::nullopt;
}

MeasuredRun measure(Run run, const FrontOptions& options, bool with_variants) {
  MeasuredRun measured{std::move(run), {}, {}};
  if (with_variants) {
    FrontWithVariants found = measure_front_variants(measured.run, options);
    measured.history = std::move(found.front);
    measured.variants = std::move(found.variants);
  } else {
    measured.history = measure_front(measured.run, options);
  }
  measured.front = dimensionless(measured.history, measured.run.physics.scales());
  return measured;
}

}  // namespace surge::compare
