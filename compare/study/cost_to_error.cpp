#include "compare/study/cost_to_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "compare/study/observable_verdicts.hpp"
#include "compare/study/sequences.hpp"
#include "compare/study/verdict.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Errors for which the cheapest run is named, in tolerances: of the leading edge 0.2 to 0.01 of
/// Z/L.
constexpr std::array<double, 6> accuracies{4.0, 2.0, 1.0, 0.6, 0.4, 0.2};

std::optional<double> stated(const json& from, const char* name) {
  if (!from.is_object() || !from.contains(name) || !from[name].is_number()) return std::nullopt;
  return from[name].get<double>();
}

/// "MPS paper" of "MPS paper, l0 = 5 mm"; of files that do not say their method, their name.
std::string method_of(const RunResult& run) {
  if (run.study.is_files()) return run.study.name;
  const std::string label = run.label();
  return label.substr(0, label.find(", "));
}

std::optional<double> simulated_seconds(const RunResult& run) {
  if (const auto s = stated(run.manifest, "simulated_s")) return s;
  const auto& times = run.measured->run.frames->times();
  return (times.back() - times.front()).value();
}

struct ErrorFound {
  double error = 0.0;
  std::optional<double> uncertainty;  ///< U, 95 %
};

/// How far a run is from what all are held against.
class ErrorRule {
 public:
  virtual ~ErrorRule() = default;
  [[nodiscard]] virtual std::optional<ErrorFound> of(const RunResult& run) const = 0;
  std::string against, quantity, unit = "1";
  const RunResult* run = nullptr;
  std::optional<double> own_uncertainty;  ///< standard, of what they are held against
  double tolerance = front_tolerance;
};

class FrontError : public ErrorRule {
 public:
  explicit FrontError(const StudyResult& study) : study_(study) {
    run = finest_vof_run(sequences_of(study));
    if (run == nullptr) run = &study.reference();
    against = run->label();
    quantity = "Leading edge Z/L";
    own_uncertainty = front_uncertainty(study, *run);
  }
  [[nodiscard]] std::optional<ErrorFound> of(const RunResult& other) const override {
    const bool coarser_than_it =
        other.measured->run.spacing.value() > 1.01 * run->measured->run.spacing.value();
    // Nothing can be said of what the others are measured against, on however many threads.
    if (other.measured->run.is_mesh() && !coarser_than_it) return std::nullopt;
    ErrorFound found;
    try {
      found.error = difference(other.measured->front, run->measured->front, study_.wall()).rms;
    } catch (const Error&) {
      return std::nullopt;  // they share no time
    }
    const auto u = front_uncertainty(study_, other);
    if (u && own_uncertainty) found.uncertainty = coverage * std::hypot(*u, *own_uncertainty);
    return found;
  }

 private:
  const StudyResult& study_;
};

class CurveError : public ErrorRule {
 public:
  CurveError(const StudyResult& study, ObservedQuantity what)
      : study_(study), what_(std::move(what)) {
    run = &study.reference();
    against = run->label();
    quantity = what_.title;
    unit = what_.unit;
    for (const RunResult* other : study.measured())
      if (const auto found = compared(*other)) {
        window_ = {found->begin, found->end};
        for (const Comparison& one : found->measures)
          if (one.verdict) {
            tolerance = one.verdict->tolerance;
            own_uncertainty = one.verdict->parts.reference;
          }
      }
  }
  [[nodiscard]] bool usable() const { return window_[1] > window_[0]; }
  [[nodiscard]] std::optional<ErrorFound> of(const RunResult& other) const override {
    const auto found = compared(other);
    // A level that ends early is not compared over the same time.
    const double slack = 0.01 * (window_[1] - window_[0]);
    if (!found || std::abs(found->begin - window_[0]) > slack ||
        std::abs(found->end - window_[1]) > slack)
      return std::nullopt;
    for (const Comparison& one : found->measures)
      if (one.measure == CurveMeasure::rms && one.verdict)
        return ErrorFound{std::abs(one.verdict->difference), one.verdict->interval()};
    return std::nullopt;
  }

 private:
  /// Against the reference run; empty where that has no RMS.
  [[nodiscard]] std::optional<CurveComparison> compared(const RunResult& other) const {
    if (&other == run || other.measured->observed.size() <= what_.observable) return std::nullopt;
    for (CurveComparison& found : compare_curve(study_, what_, other)) {
      if (found.against != run->study.name || !found.skipped.empty()) continue;
      const bool has = std::any_of(found.measures.begin(), found.measures.end(), [](const auto& m) {
        return m.measure == CurveMeasure::rms && m.verdict.has_value();
      });
      if (has) return std::move(found);
    }
    return std::nullopt;
  }

  const StudyResult& study_;
  ObservedQuantity what_;
  std::array<double, 2> window_{0.0, 0.0};
};

std::unique_ptr<ErrorRule> rule_of(const StudyResult& study) {
  if (study.has_front) return std::make_unique<FrontError>(study);
  for (const ObservedQuantity& quantity : observed_quantities(study)) {
    auto rule = std::make_unique<CurveError>(study, quantity);
    if (rule->usable()) return rule;
  }
  return nullptr;
}

/// The runs of the comparison and their levels over the spacing; those that vary the step alone say
/// nothing of what a resolution costs.
std::vector<const RunResult*> runs_with_levels(const StudyResult& study) {
  std::vector<const RunResult*> runs = study.measured();
  for (const Sequence& sequence : sequences_of(study)) {
    if (!sequence.over_spacing) continue;
    for (const auto* list : {&sequence.levels, &sequence.others})
      for (const SequenceLevel& level : *list)
        if (std::find(runs.begin(), runs.end(), level.run) == runs.end()) runs.push_back(level.run);
  }
  return runs;
}

json points_of(const StudyResult& study, const ErrorRule& rule) {
  json points = json::array();
  for (const RunResult* run : runs_with_levels(study)) {
    if (run == rule.run || run->status != RunStatus::complete) continue;
    const auto cpu = cpu_seconds_of(*run), simulated = simulated_seconds(*run);
    if (!cpu || !simulated || !(*simulated > 0.0)) continue;
    const auto error = rule.of(*run);
    if (!error) continue;
    const json wall = run->manifest.is_object() && run->manifest.contains("wall_s")
                          ? run->manifest["wall_s"]
                          : json();
    const auto total = stated(wall, "total");
    points.push_back({{"run", run->study.name},
                      {"label", run->label()},
                      {"method", method_of(*run)},
                      {"spacing_m", run->measured->run.spacing.value()},
                      {"threads", run->study.is_files() ? json() : json(run->study.threads)},
                      {"files", run->study.is_files()},
                      {"cpu", run->manifest.is_object() ? run->manifest.value("cpu", "") : ""},
                      {"cpu_s_per_s", *cpu / *simulated},
                      {"wall_s_per_s", total ? json(*total / *simulated) : json()},
                      {"E", error->error},
                      {"U", json_or_null(error->uncertainty)},
                      {"speedup", nullptr}});
  }
  std::stable_sort(points.begin(), points.end(), [](const json& a, const json& b) {
    return a["cpu_s_per_s"].get<double>() < b["cpu_s_per_s"].get<double>();
  });
  return points;
}

/// How much faster than on one thread: the same method and spacing on the same processor.
void find_speedups(json& points) {
  for (json& point : points) {
    if (!point["threads"].is_number() || point["threads"] == 1 || point["wall_s_per_s"].is_null())
      continue;
    for (const json& one : points)
      if (one["threads"] == 1 && one["method"] == point["method"] && one["cpu"] == point["cpu"] &&
          std::abs(one["spacing_m"].get<double>() / point["spacing_m"].get<double>() - 1.0) <
              0.01 &&
          one["wall_s_per_s"].is_number())
        point["speedup"] = one["wall_s_per_s"].get<double>() / point["wall_s_per_s"].get<double>();
  }
}

/// The processor that computed most of the points: costs on two of them are not compared.
std::string usual_cpu(const json& points) {
  std::map<std::string, int> counts;
  for (const json& point : points)
    if (!point["files"].get<bool>()) ++counts[point["cpu"].get<std::string>()];
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

/// The methods in the order of their first runs in the study.
json methods_of(const StudyResult& study, const json& points) {
  json methods = json::array();
  for (const RunResult* run : runs_with_levels(study)) {
    const std::string method = method_of(*run);
    const bool here = std::any_of(points.begin(), points.end(),
                                  [&](const json& point) { return point["method"] == method; });
    if (here && std::find(methods.begin(), methods.end(), json(method)) == methods.end())
      methods.push_back(method);
  }
  return methods;
}

json level_json(const json& points, const json& methods, const std::string& cpu, double error) {
  json level{{"E", error}, {"cells", json::array()}};
  std::optional<double> cheapest;
  for (const json& method : methods) {
    json cell{{"method", method}, {"point", nullptr}, {"factor", nullptr}};
    for (std::size_t k = 0; k < points.size() && cell["point"].is_null(); ++k) {
      const json& point = points[k];
      if (point["method"] == method && point["threads"] == 1 && point["cpu"] == cpu &&
          point["E"] <= error)
        cell["point"] = k;
    }
    if (cell["point"].is_number()) {
      const double cost = points[cell["point"].get<std::size_t>()]["cpu_s_per_s"];
      cheapest = std::min(cheapest.value_or(cost), cost);
    }
    level["cells"].push_back(std::move(cell));
  }
  for (json& cell : level["cells"])
    if (cell["point"].is_number())
      cell["factor"] =
          points[cell["point"].get<std::size_t>()]["cpu_s_per_s"].get<double>() / *cheapest;
  return level;
}

}  // namespace

std::optional<double> cpu_seconds_of(const RunResult& run) {
  if (run.study.is_files()) return stated(run.study.resolved, "cpu_s");
  const auto cpu = stated(run.manifest, "cpu_s");
  // interFoam's log has the time of its first process.
  if (cpu) return run.measured->run.is_mesh() ? *cpu * run.study.threads : *cpu;
  if (!run.manifest.is_object() || !run.manifest.contains("wall_s")) return std::nullopt;
  const auto wall = stated(run.manifest["wall_s"], "total");
  return wall ? std::optional(*wall * run.study.threads) : std::nullopt;
}

void measure_cost_to_error(const StudyResult& study, json& metrics) {
  json& out = metrics["cost_to_error"] = json::object();
  const auto rule = rule_of(study);
  if (!rule) return;
  json points = points_of(study, *rule);
  if (points.empty()) return;
  find_speedups(points);
  out = {{"against", rule->against}, {"quantity", rule->quantity},
         {"unit", rule->unit},       {"against_u", json_or_null(rule->own_uncertainty)},
         {"cpu", usual_cpu(points)}, {"methods", methods_of(study, points)},
         {"levels", json::array()}};
  for (const double part : accuracies)
    out["levels"].push_back(level_json(points, out["methods"], out["cpu"], part * rule->tolerance));
  out["points"] = std::move(points);
}

}  // namespace surge::compare
