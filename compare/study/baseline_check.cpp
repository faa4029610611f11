#include "compare/study/baseline_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/measure/measure_all.hpp"
#include "compare/measure/registry.hpp"
#include "compare/read/foam_case.hpp"
#include "compare/study/quantities.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double most_intervals = 1.5;  ///< of the baseline, between two frames of a source
constexpr double rounding = 1e-9;       ///< s or m: places that close are one

std::string text_of(double value) {
  return std::isfinite(value) ? six_digits(value) : "missing";
}

/// A curve as it was found: linear between neighbours that are near enough to each other.
class FoundCurve {
 public:
  FoundCurve(std::vector<double> at, std::vector<double> values, double widest)
      : at_(std::move(at)), values_(std::move(values)), widest_(widest) {}

  /// The least and the largest value within `reach` of a place where it has a value.
  struct Band {
    double here = 0.0, low = 0.0, high = 0.0;
  };
  [[nodiscard]] std::optional<Band> band(double place, double reach) const {
    if (at_.empty()) return std::nullopt;
    const double inside = std::clamp(place, at_.front(), at_.back());
    if (std::abs(inside - place) > reach + rounding) return std::nullopt;
    const double here = value(inside);
    if (!std::isfinite(here)) return std::nullopt;
    Band band{here, here, here};
    const double from = std::max(place - reach, at_.front());
    const double to = std::min(place + reach, at_.back());
    widen(band, value(from));
    widen(band, value(to));
    for (std::size_t i = 0; i < at_.size(); ++i)
      if (at_[i] > from && at_[i] < to) widen(band, values_[i]);
    return band;
  }

  /// Why there is no value.
  [[nodiscard]] std::string absence(double place, const std::string& unit) const {
    if (at_.empty()) return "found nothing at any time";
    if (place < at_.front() - rounding || place > at_.back() + rounding)
      return "found values from " + six_digits(at_.front()) + " to " + six_digits(at_.back()) +
             ' ' + unit + " only";
    const auto after = std::upper_bound(at_.begin(), at_.end(), place);
    if (after == at_.begin() || after == at_.end()) return "found no finite value there";
    const double gap = *after - *(after - 1);
    if (gap <= widest_) return "found no finite value there";
    return "found nothing between " + six_digits(*(after - 1)) + " and " + six_digits(*after) +
           ' ' + unit + ", expected values no further apart than " + six_digits(widest_);
  }

 private:
  static void widen(Band& band, double value) {
    if (!std::isfinite(value)) return;
    band.low = std::min(band.low, value);
    band.high = std::max(band.high, value);
  }
  [[nodiscard]] double value(double place) const {
    const auto after = std::lower_bound(at_.begin(), at_.end(), place - rounding);
    if (after == at_.end()) return nothing;
    const auto i = static_cast<std::size_t>(after - at_.begin());
    if (std::abs(at_[i] - place) <= rounding) return values_[i];
    if (i == 0 || at_[i] - at_[i - 1] > widest_) return nothing;
    const double w = (place - at_[i - 1]) / (at_[i] - at_[i - 1]);
    return (1.0 - w) * values_[i - 1] + w * values_[i];
  }

  std::vector<double> at_, values_;
  double widest_;
};

/// Missing is worse than any deviation; else what is furthest outside of its tolerance.
double badness(const Finding& f) {
  return std::isfinite(f.deviation) ? std::abs(f.deviation) - f.tolerance
                                    : std::numeric_limits<double>::infinity();
}

Finding failure(const std::string& quantity, const std::string& why) {
  return {quantity, Status::failed, "", "missing", "values", "", nothing, 0.0, why};
}

Finding judge_point(const BaselineCurve& curve, std::size_t i, const FoundCurve& found) {
  const std::string unit = curve.time ? "m" : "s";
  const double expected = curve.values[i];
  Finding finding{curve.name(),
                  Status::failed,
                  six_digits(curve.at[i]) + ' ' + unit,
                  "missing",
                  text_of(expected),
                  curve.unit,
                  nothing,
                  curve.tolerance.of(expected),
                  ""};
  const auto band = found.band(curve.at[i], curve.time ? 0.0 : curve.tolerance.time);
  if (!band) {
    finding.why = found.absence(curve.at[i], unit);
    return finding;
  }
  finding.found = text_of(band->here);
  finding.deviation = expected < band->low    ? band->low - expected
                      : expected > band->high ? band->high - expected
                                              : 0.0;
  if (std::abs(finding.deviation) <= finding.tolerance) finding.status = Status::passed;
  return finding;
}

/// One result among those of an observable.
struct Result {
  std::string unit;
  std::vector<double> at, values;
};

std::vector<double> plain(const std::vector<std::optional<double>>& values) {
  std::vector<double> list;
  for (const auto& value : values) list.push_back(value.value_or(nothing));
  return list;
}

std::optional<Result> result_of(const Findings& found, const BaselineCurve& curve) {
  if (!curve.time) {
    for (const TimeSeries& series : found.series) {
      if (series.name != curve.series) continue;
      std::vector<double> times;
      for (const Seconds t : series.times) times.push_back(t.value());
      return Result{series.unit, times, plain(series.values)};
    }
    return std::nullopt;
  }
  for (const Profile& profile : found.profiles) {
    const double off = std::abs(profile.time.value() - *curve.time);
    if (profile.name != curve.series || off > curve.tolerance.time + rounding) continue;
    return Result{profile.unit, profile.positions, plain(profile.values)};
  }
  return std::nullopt;
}

BaselineComparison inside_window(const BaselineCurve& curve, const Result& result,
                                 const Baseline& baseline) {
  BaselineComparison comparison{curve, {}, {}, {}};
  for (std::size_t i = 0; i < result.at.size(); ++i) {
    const bool outside = !curve.time && (result.at[i] < baseline.from - rounding ||
                                         result.at[i] > baseline.until + rounding);
    if (outside || !std::isfinite(result.values[i])) continue;
    comparison.at.push_back(result.at[i]);
    comparison.values.push_back(result.values[i]);
  }
  return comparison;
}

void check_curve(const BaselineCurve& curve, const Findings& found, const Baseline& baseline,
                 CheckResult& checked) {
  const std::string name = curve.name();
  if (found.failure) {
    checked.findings.push_back(failure(name, *found.failure));
    return;
  }
  const auto result = result_of(found, curve);
  if (!result) {
    checked.findings.push_back(failure(name, "the source has no such result at that time"));
    return;
  }
  if (result->unit != curve.unit) {
    checked.findings.push_back(
        failure(name, "found the unit " + result->unit + ", expected " + curve.unit));
    return;
  }
  const FoundCurve values(result->at, result->values, most_intervals * curve.interval + rounding);
  std::optional<std::size_t> worst;
  Finding finding;
  for (std::size_t i = 0; i < curve.at.size(); ++i) {
    Finding point = judge_point(curve, i, values);
    if (worst && badness(point) <= badness(finding)) continue;
    finding = std::move(point);
    worst = i;
  }
  checked.findings.push_back(std::move(finding));
  checked.curves.push_back(inside_window(curve, *result, baseline));
  checked.curves.back().worst = curve.at[*worst];
}

Finding check_word(const std::string& key, const std::map<std::string, std::string>& identity,
                   const std::string& expected) {
  const auto found = identity.find(key);
  const std::string text = found == identity.end() ? "missing" : found->second;
  const bool same = text == expected;
  return {key,
          same ? Status::passed : Status::failed,
          "",
          text,
          expected,
          "",
          same ? 0.0 : nothing,
          0.0,
          ""};
}

Finding check_value(const std::string& name, const std::optional<double>& found,
                    const Baseline::Value& value) {
  Finding finding{name,    Status::failed,  "", "missing", text_of(value.value), "",
                  nothing, value.tolerance, ""};
  if (!found) return finding;
  finding.found = text_of(*found);
  finding.deviation = *found - value.value;
  if (std::abs(finding.deviation) <= value.tolerance) finding.status = Status::passed;
  return finding;
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

std::size_t CheckResult::failed() const {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [](const Finding& f) { return f.status != Status::passed; }));
}

ObservedRun observe(Run run, const FrontOptions& front,
                    const std::vector<std::string>& observables) {
  ObservedRun observed{std::move(run), observables, {}};
  observed.found.resize(observables.size());
  const ObservableContext context{observed.run, front, nullptr};
  std::vector<std::unique_ptr<Observable>> made;
  std::vector<std::size_t> index;
  for (std::size_t k = 0; k < observables.size(); ++k) {
    try {
      made.push_back(make_observable(observables[k], context));
      index.push_back(k);
    } catch (const Error& error) {
      observed.found[k].failure = error.what();
    }
  }
  std::vector<Findings> found = measure_all(observed.run, made);
  for (std::size_t i = 0; i < found.size(); ++i) observed.found[index[i]] = std::move(found[i]);
  return observed;
}

CheckResult check(const ObservedRun& source, const Baseline& baseline) {
  CheckResult checked;
  const auto identity = identity_of(source.run);
  for (const auto& [key, expected] : baseline.identity)
    checked.findings.push_back(check_word(key, identity, expected));
  for (const BaselineCurve& curve : baseline.curves) {
    const auto asked =
        std::find(source.observables.begin(), source.observables.end(), curve.observable);
    if (asked == source.observables.end()) {
      checked.findings.push_back(failure(curve.name(), "was not measured"));
      continue;
    }
    const auto k = static_cast<std::size_t>(asked - source.observables.begin());
    check_curve(curve, source.found[k], baseline, checked);
  }
  const FrontHistory history = front_of(source);
  for (const auto& [name, value] : baseline.values)
    checked.findings.push_back(check_value(name, held_scalar(source.run, history, name), value));
  if (checked.findings.empty())
    checked.findings.push_back(failure("baseline", "nothing was compared"));
  return checked;
}

}  // namespace surge::compare
