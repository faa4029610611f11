#include "compare/measure/front_pace.hpp"

#include <algorithm>
#include <cmath>

#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

// Between them lie collapses of columns half to four times as high as wide, inviscid or nearly so;
// wider and taller ones are faster over the box.
constexpr double slowest = 1.5, fastest = 0.45, fastest_slender = 0.15;
constexpr double followed = 0.5;  ///< of L
constexpr double enough = 0.2;    ///< of L

std::string pace_text(double value) {
  return number_text(std::round(value * 1e4) / 1e4);
}

/// When the front first has moved by a distance, linear between frames.
double time_of(const FrontHistory& history, double distance) {
  const double place = history.front().position.value() + distance;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const double a = history[i - 1].position.value(), b = history[i].position.value();
    if (b < place) continue;
    const double w = std::clamp((place - a) / (b - a), 0.0, 1.0);
    return (1.0 - w) * history[i - 1].time.value() + w * history[i].time.value();
  }
  return history.back().time.value();
}

}  // namespace

double box_time(double height_over_width, double s) {
  // With s = 1 + q^2 the integrand is smooth; Simpson's rule.
  const double ratio = height_over_width * height_over_width;
  const auto integrand = [&](double q) {
    const double w = 1.0 + q * q;
    return 2.0 * std::sqrt(w * (1.0 + ratio / (w * w * w * w)) / 3.0);
  };
  constexpr int steps = 40;
  const double end = std::sqrt(s - 1.0), h = end / steps;
  double sum = integrand(0.0) + integrand(end);
  for (int k = 1; k < steps; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * integrand(k * h);
  return sum * h / 3.0;
}

std::vector<std::string> pace_notices(const Run& run, const FrontHistory& history) {
  const Physics& physics = run.physics;
  const bool foreign = run.kind == SourceKind::particle_series && run.manifest.is_null();
  if (!foreign || history.size() < 2 || physics.bed_depth().value_or(Metres(0.0)) > Metres(0.0))
    return {};
  if (std::abs(history.front().time.value()) > 1e-9) return {};
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double width = physics.column_width().value();
  const double height = physics.column.upper[up] - physics.column.lower[up];
  if (!(height > 0.0)) return {};
  const double unit = width / std::sqrt(physics.gravity_magnitude() * height);
  const double start = history.front().position.value();
  double farthest = start;
  for (const FrontSample& sample : history) farthest = std::max(farthest, sample.position.value());
  const double moved = (farthest - start) / width, end = history.back().time.value();
  const double aspect = height / width;
  if (farthest - start < 0.5 * run.spacing.value()) {
    // Even the slow box would have moved by two spacings.
    const double seen = std::min(enough, 2.0 * run.spacing.value() / width);
    if (end < unit * box_time(aspect, 1.0 + seen)) return {};
    return {"the leading edge does not move within " + pace_text(end) +
            " s (walls or air among the water, water that flows the other way (--axes, "
            "--tank-width), or still water?)"};
  }
  if (moved < enough) return {};
  const double distance = std::min(moved, followed);
  const double took = time_of(history, distance * width);
  const double box = unit * box_time(aspect, 1.0 + distance);
  const double least = aspect < 0.5 || aspect > 4.0 ? fastest_slender : fastest;
  if (took > least * box && took < slowest * box) return {};
  return {"the leading edge takes " + pace_text(took) + " s to move by " + pace_text(distance) +
          " L; " + pace_text(least * box) + " to " + pace_text(slowest * box) +
          " s are usual for a column of that size and gravity (--time-step, times, units, "
          "--gravity? a viscous flow?)"};
}

}  // namespace surge::compare
