#include "compare/study/baseline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "compare/study/quantities.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr DimensionlessLength blessed_wall_distance{0.1};
constexpr double blessed_step = 0.1;

std::string text_of(double value) {
  std::ostringstream out;
  out.precision(6);
  out << value;
  return out.str();
}

/// A value against its baseline.
Finding judge(const std::string& quantity, const std::string& place, std::optional<double> found,
              double expected, double tolerance) {
  Finding finding{quantity,          Status::failed, place,    "missing",
                  text_of(expected), nothing,        tolerance};
  if (!found || !std::isfinite(*found)) return finding;
  finding.found = text_of(*found);
  finding.deviation = *found - expected;
  if (std::abs(finding.deviation) <= tolerance) finding.status = Status::passed;
  return finding;
}

/// Missing is worse than any deviation.
bool is_worse(const Finding& a, const Finding& b) {
  const auto badness = [](const Finding& f) {
    return std::isfinite(f.deviation) ? std::abs(f.deviation)
                                      : std::numeric_limits<double>::infinity();
  };
  return badness(a) > badness(b);
}

Finding worst_of(const std::vector<Finding>& findings) {
  Finding worst = findings.front();
  for (const Finding& finding : findings) {
    if (is_worse(finding, worst)) worst = finding;
  }
  return worst;
}

template <class Kind>
std::optional<double> plain(const std::optional<Kind>& quantity) {
  return quantity ? std::optional(quantity->value()) : std::nullopt;
}

std::map<std::string, std::string> identity_of(const Run& run) {
  return {{"method", run.method}, {"preset", run.preset}};
}

}  // namespace

const char* status_text(Status status) {
  switch (status) {
    case Status::passed:
      return "passed";
    case Status::failed:
      return "failed";
    case Status::skipped:
      return "skipped";
  }
  return "failed";
}

std::vector<Finding> check(const MeasuredRun& run, const Baseline& baseline) {
  std::vector<Finding> findings;
  const auto identity = identity_of(run.run);
  for (const auto& [key, expected] : baseline.identity) {
    const auto found = identity.find(key);
    const std::string text = found == identity.end() ? "missing" : found->second;
    const bool same = text == expected;
    findings.push_back({key, same ? Status::passed : Status::failed, "", text, expected,
                        same ? 0.0 : nothing, 0.0});
  }
  std::vector<Finding> points;
  for (const auto& sample : baseline.front.samples) {
    points.push_back(judge("front Z/L", "T = " + text_of(sample.time.value()),
                           plain(run.front.at(sample.time)), sample.position.value(),
                           baseline.front_tolerance.value()));
  }
  findings.push_back(worst_of(points));
  std::vector<Finding> arrivals;
  for (const auto& [level, time] : baseline.arrival) {
    arrivals.push_back(judge("arrival T", "Z/L = " + level,
                             plain(run.front.arrival(DimensionlessLength(std::stod(level)))),
                             time.value(), baseline.arrival_tolerance.value()));
  }
  if (!arrivals.empty()) findings.push_back(worst_of(arrivals));
  for (const auto& [name, value] : baseline.scalars) {
    findings.push_back(judge(name, "", scalar(run, name), value.value, value.tolerance));
  }
  return findings;
}

Baseline bless(const MeasuredRun& run, const FrontOptions& options, const Tolerances& tolerances,
               const Provenance& measured) {
  const std::string place = run.run.path.string() + ": ";
  if (options.raw_maximum)
    throw Error(place + "--raw-maximum found, a baseline of the leading edge expected");
  if (scalar(run, "finished").value_or(1.0) != 1.0)
    throw Error(place + "not finished, a finished run expected");
  Baseline baseline;
  baseline.measured = measured;
  baseline.strip_height = options.strip_height;
  baseline.linking_length = options.linking_length;
  baseline.identity = identity_of(run.run);
  baseline.front_tolerance = tolerances.front;
  baseline.arrival_tolerance = tolerances.time;
  const Window window =
      common_window(run.front, run.front, wall_rule(run.run, blessed_wall_distance));
  const double first = std::ceil(window.begin.value() / blessed_step - 1e-9);
  for (double k = first; k * blessed_step <= window.end.value(); k += 1.0) {
    const DimensionlessTime time(k * blessed_step);
    const auto position = run.front.at(time);
    if (position) baseline.front.samples.push_back({time, *position});
  }
  if (baseline.front.samples.empty())
    throw Error(place + "no front before the far wall found, one expected");
  for (const double level : arrival_levels) {
    const auto time = run.front.arrival(DimensionlessLength(level));
    if (time) baseline.arrival[level_text(level)] = *time;
  }
  const Scales scales = run.run.physics.scales();
  for (const char* name : {"spacing_m", "column_width_m", "gravity"}) {
    const double value = scalar(run, name).value();
    baseline.scalars[name] = {value, 1e-6 * value};
  }
  if (const auto hit = scalar(run, "impact_time_s")) {
    baseline.scalars["impact_time_s"] = {*hit, scales.dimensional(tolerances.time).value()};
  }
  for (const char* name : {"finished", "lost_particles", "nonfinite"}) {
    if (const auto count = scalar(run, name)) baseline.scalars[name] = {*count, 0.0};
  }
  return baseline;
}

}  // namespace surge::compare
