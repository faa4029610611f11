#include "compare/measure/wall_pressure.hpp"

#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>
#include <limits>

#include "compare/measure/recorded.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

PressureSignal::PressureSignal(std::vector<double> time, std::vector<double> pressure)
    : time_(std::move(time)), pressure_(std::move(pressure)), sum_(time_.size(), 0.0) {
  if (time_.size() < 2 || pressure_.size() != time_.size())
    throw Error("pressure over time: found " + std::to_string(time_.size()) + " times and " +
                std::to_string(pressure_.size()) + " values, expected two or more of both");
  for (std::size_t i = 1; i < time_.size(); ++i) {
    if (!(time_[i] > time_[i - 1]))
      throw Error("pressure over time: found " + std::to_string(time_[i]) + " s after " +
                  std::to_string(time_[i - 1]) + " s, expected increasing times");
    sum_[i] = sum_[i - 1] + 0.5 * (pressure_[i] + pressure_[i - 1]) * (time_[i] - time_[i - 1]);
  }
}

double PressureSignal::until(double t) const {
  const auto after = std::upper_bound(time_.begin() + 1, time_.end() - 1, t);
  const auto i = static_cast<std::size_t>(after - time_.begin()) - 1;
  const double dt = t - time_[i];
  const double slope = (pressure_[i + 1] - pressure_[i]) / (time_[i + 1] - time_[i]);
  return sum_[i] + dt * (pressure_[i] + 0.5 * slope * dt);
}

double PressureSignal::integral(double begin, double end) const {
  return until(end) - until(begin);
}

double PressureSignal::mean(double t, double interval) const {
  return integral(t - 0.5 * interval, t + 0.5 * interval) / interval;
}

std::optional<double> PressureSignal::median_step(double begin, double end) const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_.size(); ++i) {
    if (time_[i - 1] >= begin && time_[i] <= end) steps.push_back(time_[i] - time_[i - 1]);
  }
  if (steps.empty()) return std::nullopt;
  return boost::math::statistics::median(steps);
}

std::optional<Vec3> wall_probe(const Run& run) {
  const nlohmann::json::json_pointer probes("/case/probes");
  if (!run.manifest.contains(probes)) return std::nullopt;
  for (const nlohmann::json& probe : run.manifest.at(probes)) {
    if (probe.value("name", "") == wall_probe_name) return probe.at("position").get<Vec3>();
  }
  return std::nullopt;
}

PressureSignal read_wall_pressure(const Run& run) {
  Recorded table = run.is_mesh() ? read_foam_probes(run, "wallPressure").pressure
                                 : read_recorded_csv(run.path / "steps.csv", {wall_probe_name});
  try {
    return {std::move(table.time), std::move(table.values.front())};
  } catch (const Error& error) {
    throw Error(run.path.string() + ": " + error.what());
  }
}

std::optional<double> pressure_scale(const Physics& physics) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double height = physics.column.upper[up] - physics.column.lower[up];
  if (!physics.density || !std::isfinite(height)) return std::nullopt;
  return *physics.density * physics.gravity_magnitude() * height;
}

namespace {

/// First of the values from which on the root mean square over `half` values to either side is at
/// most `bar`; their number where the last one is above.
std::size_t quiet_from(const std::vector<double>& values, std::size_t half, double bar) {
  std::vector<double> sum(values.size() + 1, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) sum[k + 1] = sum[k] + values[k] * values[k];
  std::size_t from = values.size();
  while (from > 0) {
    const std::size_t k = from - 1;
    const std::size_t begin = k - std::min(k, half), end = std::min(k + half + 1, values.size());
    if (sum[end] - sum[begin] > bar * bar * static_cast<double>(end - begin)) break;
    from = k;
  }
  return from;
}

}  // namespace

std::optional<ImpactPressure> impact_pressure(const PressureSignal& signal, const Physics& physics,
                                              Seconds impact) {
  const Scales scales = physics.scales();
  const auto scale = pressure_scale(physics);
  const double begin = impact.value();
  const double end = begin + scales.dimensional(impact_duration).value();
  const double margin = 0.5 * noise_interval.value();
  if (!scale || !signal.covers(begin - margin, end + margin)) return std::nullopt;
  ImpactPressure found;
  found.peak = -std::numeric_limits<double>::infinity();
  const double d = sensor_interval.value();
  const auto count = static_cast<long>(std::floor((end - begin) / d * (1.0 + 1e-12))) + 1;
  double squares = 0.0, load = 0.0;
  std::vector<double> rest;
  for (long k = 0; k < count; ++k) {
    const double t = begin + static_cast<double>(k) * d;
    const double p = signal.mean(t, d) / *scale;
    if (p > found.peak) {
      found.peak = p;
      found.time_of_peak = scales.dimensionless(Seconds(t - begin));
    }
    const double mean = signal.mean(t, noise_interval.value()) / *scale;
    load = std::max(load, mean);
    rest.push_back(p - mean);
    squares += rest.back() * rest.back();
  }
  found.noise = std::sqrt(squares / static_cast<double>(count));
  const std::size_t from =
      quiet_from(rest, static_cast<std::size_t>(std::lround(margin / d)), readable_noise * load);
  if (from < rest.size())
    found.readable_from = scales.dimensionless(Seconds(static_cast<double>(from) * d));
  found.impulse = scales.dimensionless(Seconds(signal.integral(begin, end) / *scale)).value();
  return found;
}

}  // namespace surge::compare
