#include <algorithm>

#include "compare/report/sections.hpp"
#include "compare/study/observable_verdicts.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

json verdict_json(const Comparison& one) {
  json out{{"unit", one.unit},
           {"run", json_or_null(one.run)},
           {"reference", json_or_null(one.reference)},
           {"why", one.why},
           {"verdict", nullptr},
           {"E", nullptr}};
  if (one.maximum) out["max"] = *one.maximum;
  if (one.bias) out["bias"] = *one.bias;
  if (one.points) out["points"] = *one.points;
  if (one.unshifted) out["E_unshifted"] = *one.unshifted;
  if (!one.verdict) return out;
  const Verdict& verdict = *one.verdict;
  out["E"] = verdict.difference;
  out["tolerance"] = verdict.tolerance;
  out["U"] = json_or_null(verdict.interval());
  out["u_val"] = json_or_null(verdict.parts.combined());
  out["u_run"] = json_or_null(verdict.parts.run);
  out["u_reference"] = json_or_null(verdict.parts.reference);
  out["u_data"] = json_or_null(verdict.parts.data);
  out["u_frames"] = json_or_null(verdict.parts.frames);
  out["verdict"] = outcome_text(verdict.outcome);
  out["why"] = verdict.why;
  return out;
}

json comparison_json(const CurveComparison& found) {
  json out{{"label", found.label},
           {"status", found.skipped.empty() ? "passed" : "skipped"},
           {"reason", found.skipped},
           {"note", found.note},
           {"measures", json::object()}};
  if (!found.skipped.empty()) return out;
  out["window"] = {found.begin, found.end};
  out["shift_s"] = found.shift;
  for (const Comparison& one : found.measures)
    out["measures"][std::string(measure_text(one.measure))] = verdict_json(one);
  return out;
}

/// What a run has of a quantity by itself.
json run_json(const StudyResult& study, const ObservedQuantity& quantity, const RunResult& run) {
  const ObservedCurve found = curve_of(quantity, *run.measured);
  const Findings& all = run.measured->observed[quantity.observable];
  json out{{"label", run.label()},       {"points", found.curve.first.size()},
           {"left_out", found.left_out}, {"failure", all.failure ? json(*all.failure) : json()},
           {"notices", all.notices},     {"against", json::object()}};
  for (const char* key : {"first", "last", "least", "most"}) out[key] = nullptr;
  if (found.curve.empty()) return out;
  const auto [least, most] =
      std::minmax_element(found.curve.value.begin(), found.curve.value.end());
  out["first"] = found.curve.value.front();
  out["last"] = found.curve.value.back();
  out["least"] = *least;
  out["most"] = *most;
  if (found.time) out["frame_s"] = *found.time;
  for (const CurveComparison& one : compare_curve(study, quantity, run))
    out["against"][one.against] = comparison_json(one);
  return out;
}

json quantity_json(const StudyResult& study, const ObservedQuantity& quantity) {
  const StudyObservable& asked = study.observables[quantity.observable];
  json out{{"observable", asked.name},
           {"request", asked.request()},
           {"title", quantity.title},
           {"unit", quantity.unit},
           {"over", quantity.is_profile() ? "x" : "t"},
           {"asked_s", json_or_null(quantity.asked)},
           {"runs", json::object()}};
  for (const RunResult* run : study.measured())
    out["runs"][run->study.name] = run_json(study, quantity, *run);
  return out;
}

json series_json(const ReferenceSeries& series) {
  return {
      {"label", series.label},    {"citation", series.citation}, {"kind", kind_text(series.kind)},
      {"case", series.case_name}, {"axes", series.axes},         {"gate", series.gate},
      {"note", series.note}};
}

}  // namespace

void measure_observables(const StudyResult& study, json& metrics) {
  json& out = metrics["observables"] = json::object();
  metrics["references"] = json::object();
  metrics["observables_failed"] = json::object();
  for (const ObservedQuantity& quantity : observed_quantities(study))
    out[quantity.key] = quantity_json(study, quantity);
  for (const ReferenceSeries& series : study.references)
    metrics["references"][series.name] = series_json(series);
  // What no run has is no quantity, but must not vanish.
  for (std::size_t k = 0; k < study.observables.size(); ++k) {
    json failed = json::object();
    for (const RunResult* run : study.measured()) {
      const std::vector<Findings>& all = run->measured->observed;
      if (k < all.size() && all[k].failure) failed[run->study.name] = *all[k].failure;
    }
    if (!failed.empty()) metrics["observables_failed"][study.observables[k].name] = failed;
  }
}

}  // namespace surge::compare
