#include "compare/study/observed_curves.hpp"

#include <algorithm>
#include <cmath>

#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

/// Values from the first one on up to the first gap.
template <class First>
void take(const std::vector<First>& first, const std::vector<std::optional<double>>& values,
          const auto& number, ObservedCurve& out) {
  std::size_t i = 0;
  while (i < values.size() && !values[i]) ++i;
  for (; i < values.size() && values[i]; ++i) {
    const double x = number(first[i]);
    if (!out.curve.first.empty() && !(x > out.curve.first.back())) continue;
    out.curve.first.push_back(x);
    out.curve.value.push_back(*values[i]);
  }
  out.left_out = values.size() - out.curve.first.size();
}

bool same_time(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(b));
}

/// "" of "name", ".x" of "name.x".
std::string component_of(const std::string& series, const std::string& name) {
  return series.size() == name.size() + 2 && series[name.size()] == '.'
             ? series.substr(series.size() - 1)
             : "";
}

void add_quantities(std::size_t index, const StudyObservable& asked, const Findings& found,
                    std::vector<ObservedQuantity>& all) {
  const auto known = [&](const std::string& key) {
    return std::any_of(all.begin(), all.end(), [&](const auto& q) { return q.key == key; });
  };
  for (const TimeSeries& series : found.series) {
    const std::string component = component_of(series.name, asked.name);
    if (!asked.component.empty() && component != asked.component) continue;
    if (known(series.name)) continue;
    const std::string along = component.empty() ? "" : ", along " + component;
    all.push_back({index, series.name, asked.title + along, series.unit, component, {}});
  }
  for (const Profile& profile : found.profiles) {
    const std::string when = number_text(profile.asked.value());
    const std::string key = asked.name + "@" + when;
    if (known(key)) continue;
    all.push_back({index, key, asked.title + ", t = " + when + " s", profile.unit, "",
                   profile.asked.value()});
  }
}

}  // namespace

std::vector<ObservedQuantity> observed_quantities(const StudyResult& study) {
  std::vector<ObservedQuantity> all;
  for (std::size_t k = 0; k < study.observables.size(); ++k)
    for (const RunResult* run : study.measured())
      if (k < run->measured->observed.size())
        add_quantities(k, study.observables[k], run->measured->observed[k], all);
  return all;
}

ObservedCurve curve_of(const ObservedQuantity& quantity, const MeasuredRun& run) {
  ObservedCurve out;
  if (quantity.observable >= run.observed.size()) return out;
  const Findings& found = run.observed[quantity.observable];
  for (const TimeSeries& series : found.series)
    if (!quantity.is_profile() && series.name == quantity.key)
      take(
          series.times, series.values, [](Seconds t) { return t.value(); }, out);
  for (const Profile& profile : found.profiles) {
    if (!quantity.is_profile() || !same_time(profile.asked.value(), *quantity.asked)) continue;
    out.time = profile.time.value();
    take(
        profile.positions, profile.values, [](double x) { return x; }, out);
    return out;
  }
  return out;
}

std::vector<const ReferenceSeries*> series_of(const StudyResult& study,
                                              const ObservedQuantity& quantity) {
  std::vector<const ReferenceSeries*> found;
  const StudyObservable& asked = study.observables[quantity.observable];
  for (const std::string& name : asked.references) {
    const ReferenceSeries& series = study.series(name);
    if (series.is_profile() != quantity.is_profile() || series.component != quantity.component)
      continue;
    if (series.is_profile()) {
      const Physics& physics = study.reference_run().run.physics;
      const double time =
          evaluate_in(*series.at_time, "s", case_symbols(physics), series.place + ": at_time");
      if (std::abs(time - *quantity.asked) > 1e-3 * std::max(time, *quantity.asked)) continue;
    }
    found.push_back(&series);
  }
  return found;
}

}  // namespace surge::compare
