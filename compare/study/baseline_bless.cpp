#include <algorithm>
#include <cmath>

#include "compare/measure/measure_all.hpp"
#include "compare/read/foam_case.hpp"
#include "compare/read/particle_reader.hpp"
#include "compare/read/recorded.hpp"
#include "compare/study/baseline_check.hpp"
#include "compare/study/quantities.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr std::size_t most_points = 500;
constexpr double usual_share = 0.02;            ///< of L for the front, else of the largest value
constexpr DimensionlessTime impact_time{0.02};  ///< of the impact, where the front states none
constexpr double place_rounding = 1e-9;

/// Six digits are finer than any tolerance of use, and keep the file readable.
double rounded(double value) {
  return std::stod(six_digits(value));
}

/// A leading edge in whatever was measured; where it was not asked for, another look at the frames.
FrontHistory any_front(ObservedRun& source, const BlessOptions& options) {
  FrontHistory history = front_of(source);
  if (!history.empty()) return history;
  try {
    return measure_front(source.run, options.front);
  } catch (const Error& error) {
    throw Error(std::string(error.what()) +
                " (it ends the window of a baseline; or expected --until SECONDS)");
  }
}

/// When a front first comes to a place.
std::optional<double> arrival(const FrontHistory& history, double place) {
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (history[i].position.value() < place) continue;
    if (i == 0) return history[0].time.value();
    const double a = history[i - 1].position.value(), b = history[i].position.value();
    const double w = (place - a) / (b - a);
    return (1.0 - w) * history[i - 1].time.value() + w * history[i].time.value();
  }
  return std::nullopt;
}

void set_window(ObservedRun& source, const BlessOptions& options, Baseline& baseline) {
  const auto& times = source.run.frames->times();
  const std::string place = source.run.path.string() + ": ";
  baseline.from = rounded(times.front().value());
  const double last = times.back().value();
  if (options.until) {
    if (options.until->value() > last + place_rounding || options.until->value() <= baseline.from)
      throw Error("--until: found " + number_text(options.until->value()) +
                  ", expected a time above " + number_text(baseline.from) + " and up to " +
                  number_text(last) + " s");
    baseline.until = options.until->value();
    baseline.because = options.because;
    return;
  }
  const auto far = source.run.physics.far_wall();
  if (!far)
    throw Error(place +
                "found no far wall that would end the window of a baseline, expected --until "
                "SECONDS (or --tank-width)");
  const Metres width = source.run.physics.column_width();
  const Metres limit = *far - options.wall_distance.value() * width;
  const FrontHistory history = any_front(source, options);
  const auto hit = arrival(history, limit.value());
  if (hit && *hit <= baseline.from)
    throw Error(place + "the front is at the far wall from the start, expected --until SECONDS");
  // Whole digits, downwards.
  baseline.until = hit ? std::floor(*hit * 1e5) / 1e5 : history.back().time.value();
  const std::string distance = number_text(options.wall_distance.value()) + " L";
  baseline.because =
      hit ? "the front is then within " + distance + " of the far wall"
          : "the last frame with a front, which is not yet within " + distance + " of the far wall";
}

/// Values at their places, without those that are not there.
struct Points {
  std::vector<double> at, values;
  std::size_t absent = 0;

  void add(double place, const std::optional<double>& value) {
    if (!value) {
      ++absent;
      return;
    }
    at.push_back(place);
    values.push_back(*value);
  }
  [[nodiscard]] double interval() const {
    double widest = 0.0;
    for (std::size_t i = 1; i < at.size(); ++i) widest = std::max(widest, at[i] - at[i - 1]);
    return widest;
  }
};

/// At even distances, linear between the values.
Points thinned(const Points& all) {
  if (all.at.size() <= most_points) return all;
  Points few;
  std::size_t i = 0;
  for (std::size_t k = 0; k < most_points; ++k) {
    const double w = static_cast<double>(k) / (most_points - 1);
    const double place = (1.0 - w) * all.at.front() + w * all.at.back();
    while (i + 2 < all.at.size() && all.at[i + 1] <= place) ++i;
    const double v = std::clamp((place - all.at[i]) / (all.at[i + 1] - all.at[i]), 0.0, 1.0);
    few.add(place, (1.0 - v) * all.values[i] + v * all.values[i + 1]);
  }
  return few;
}

/// The number that is given for a result, for its observable, or for all.
std::optional<double> given(const std::map<std::string, double>& numbers,
                            const BaselineCurve& curve) {
  for (const std::string& name : {curve.series, curve.observable, std::string()}) {
    const auto found = numbers.find(name);
    if (found != numbers.end()) return found->second;
  }
  return std::nullopt;
}

Tolerance tolerance_of(const BaselineCurve& curve, const BlessOptions& options, const Run& run) {
  Tolerance tolerance;
  tolerance.time = given(options.time, curve).value_or(0.0);
  const auto absolute = given(options.absolute, curve), relative = given(options.relative, curve);
  tolerance.absolute = absolute.value_or(0.0);
  tolerance.relative = relative.value_or(0.0);
  if (absolute || relative) return tolerance;
  double largest = 0.0;
  for (const double value : curve.values) largest = std::max(largest, std::abs(value));
  const bool front = curve.observable == "front";
  tolerance.absolute =
      rounded(usual_share * (front ? run.physics.column_width().value() : largest));
  if (tolerance.absolute == 0.0)
    throw Error(curve.name() + ": all values are 0, expected --absolute \"" + curve.series +
                "=VALUE\"");
  return tolerance;
}

class Maker {
 public:
  Maker(ObservedRun& source, const BlessOptions& options, Baseline& baseline)
      : source_(source), options_(options), baseline_(baseline) {}

  void add_all() {
    for (std::size_t k = 0; k < source_.found.size(); ++k) {
      const Findings& found = source_.found[k];
      if (found.failure) throw Error(source_.observables[k] + ": " + *found.failure);
      for (const TimeSeries& series : found.series) add_series(source_.observables[k], series);
      for (const Profile& profile : found.profiles) add_profile(source_.observables[k], profile);
      if (found.series.empty() && found.profiles.empty())
        throw Error(source_.observables[k] + ": found nothing, expected a result to store");
    }
  }

 private:
  void add_series(const std::string& observable, const TimeSeries& series) {
    Points points;
    for (std::size_t i = 0; i < series.times.size(); ++i) {
      const double time = series.times[i].value();
      if (time >= baseline_.from - place_rounding && time <= baseline_.until + place_rounding)
        points.add(time, series.values[i]);
    }
    store({observable, series.name, series.unit, std::nullopt, {}, {}, 0.0, {}}, points);
  }

  void add_profile(const std::string& observable, const Profile& profile) {
    if (profile.time.value() > baseline_.until + place_rounding)
      throw Error(observable + ": found a profile at " + number_text(profile.time.value()) +
                  " s, expected times up to the end of the window, " +
                  number_text(baseline_.until) + " s (--until)");
    Points points;
    for (std::size_t i = 0; i < profile.positions.size(); ++i)
      points.add(profile.positions[i], profile.values[i]);
    store({observable, profile.name, profile.unit, profile.time.value(), {}, {}, 0.0, {}}, points);
  }

  void store(BaselineCurve curve, const Points& all) {
    if (all.at.empty())
      throw Error(curve.name() + ": found no value in the window, expected one at least");
    // The start alone is what every run has.
    if (!curve.time && all.at.size() < 2)
      throw Error(curve.name() + ": found one value in the window, expected two times at least");
    if (all.absent > 0)
      source_.run.notices.push_back(curve.name() + ": " + std::to_string(all.absent) + " of " +
                                    std::to_string(all.absent + all.at.size()) +
                                    " places have no value and are not held");
    const Points points = thinned(all);
    curve.interval = all.interval();
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      const double place = rounded(points.at[i]);
      if (!curve.at.empty() && place <= curve.at.back()) continue;
      curve.at.push_back(place);
      curve.values.push_back(rounded(points.values[i]));
    }
    curve.tolerance = tolerance_of(curve, options_, source_.run);
    baseline_.curves.push_back(std::move(curve));
  }

  ObservedRun& source_;
  const BlessOptions& options_;
  Baseline& baseline_;
};

/// A tolerance for what is not there would be a misspelling.
void check_names(const Baseline& baseline, const BlessOptions& options) {
  for (const auto* numbers : {&options.absolute, &options.relative, &options.time})
    for (const auto& [name, value] : *numbers) {
      std::string names;
      bool known = name.empty();
      for (const BaselineCurve& curve : baseline.curves) {
        known = known || name == curve.series || name == curve.observable;
        names += (names.empty() ? "" : ", ") + curve.series;
      }
      if (!known)
        throw Error("tolerance of \"" + name + "\": found no such result, expected one of " +
                    names);
    }
}

void add_values(const ObservedRun& source, const BlessOptions& options, Baseline& baseline) {
  const FrontHistory history = front_of(source);
  for (const char* name : {"spacing_m", "column_width_m", "gravity"}) {
    const auto value = scalar(source.run, history, name);
    if (value) baseline.values[name] = {*value, 1e-6 * *value};
  }
  const auto hit = scalar(source.run, history, "impact_time_s");
  if (hit && (!options.until || *hit <= baseline.until)) {
    const auto stated = options.time.find("front");
    const double usual = source.run.physics.scales().dimensional(impact_time).value();
    baseline.values["impact_time_s"] = {
        rounded(*hit), rounded(stated == options.time.end() ? usual : stated->second)};
  }
  for (const char* name : {"finished", "fluid_particles", "lost_particles", "nonfinite"})
    if (const auto count = held_scalar(source.run, history, name))
      baseline.values[name] = {*count, 0.0};
}

}  // namespace

FrontHistory front_of(const ObservedRun& source) {
  FrontHistory history;
  for (std::size_t k = 0; k < source.observables.size(); ++k) {
    if (source.observables[k] != "front" || source.found[k].series.empty()) continue;
    const TimeSeries& series = source.found[k].series.front();
    for (std::size_t i = 0; i < series.values.size(); ++i)
      if (series.values[i]) history.push_back({series.times[i], Metres(*series.values[i])});
    break;
  }
  return history;
}

std::optional<double> held_scalar(const Run& run, const FrontHistory& front,
                                  const std::string& name) {
  const auto* files = dynamic_cast<const ParticleSeries*>(run.frames.get());
  const auto counts = files != nullptr ? files->counts() : std::nullopt;
  if (run.manifest.is_null() && counts) {
    if (name == "fluid_particles") return static_cast<double>(counts->first);
    if (name == "nonfinite") return static_cast<double>(counts->nonfinite);
  }
  return scalar(run, front, name);
}

std::map<std::string, std::string> identity_of(const Run& run) {
  std::map<std::string, std::string> words{{"method", run.method},
                                           {"preset", run.preset},
                                           {"dimension", std::to_string(run.physics.dimension)}};
  for (const auto& [key, value] : run.reading) words["read as " + key] = value;
  return words;
}

Baseline bless(ObservedRun& source, const BlessOptions& options, const Provenance& measured) {
  const std::string place = source.run.path.string() + ": ";
  if (options.front.raw_maximum)
    throw Error(place + "--raw-maximum found, a baseline of the leading edge expected");
  if (is_unfinished(source.run) ||
      scalar(source.run, FrontHistory{}, "finished").value_or(1.0) != 1.0)
    throw Error(place + "not finished, a finished run expected");
  Baseline baseline;
  baseline.measured = measured;
  baseline.front = options.front;
  baseline.identity = identity_of(source.run);
  set_window(source, options, baseline);
  Maker(source, options, baseline).add_all();
  check_names(baseline, options);
  add_values(source, options, baseline);
  return baseline;
}

}  // namespace surge::compare
