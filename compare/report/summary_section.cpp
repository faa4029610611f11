#include <algorithm>
#include <cctype>
#include <set>

#include "compare/report/claim_parts.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// The complete run of a method that is nearest to the reference, among those of the paper or the
/// others; null where there is none.
const RunResult* nearest_run(const StudyResult& study, const json& metrics,
                             const std::string& method, bool of_the_paper, const std::string& rms) {
  const RunResult* best = nullptr;
  const auto error = [&](const RunResult& run) {
    return metrics["front"][run.study.name][rms].get<double>();
  };
  for (const RunResult* run : study.measured()) {
    const bool counts = run != &study.reference() && run->status == RunStatus::complete &&
                        run->note.empty() && run->measured->run.method == method &&
                        is_of_the_paper(study, *run) == of_the_paper;
    if (counts && (best == nullptr || error(*run) < error(*best))) best = run;
  }
  return best;
}

/// Numbers of the run that speaks for a method in the summary's sentences.
json entry_of(const RunResult* run, const json& metrics, const std::string& against) {
  if (run == nullptr) return nullptr;
  const json& front = metrics["front"][run->study.name];
  const json& timing = metrics["timing"][run->study.name];
  return {{"run", run->study.name},
          {"label", run->label()},
          {"rms", front["rms_vs_" + against]},
          {"max", front["max_vs_" + against]},
          {"bias", front["bias_vs_" + against]},
          {"wall_s", timing.contains("wall_s") ? timing["wall_s"] : json()}};
}

/// "MPS" of "mps".
std::string upper_case(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

}  // namespace

void measure_summary(const StudyResult& study, json& metrics) {
  const std::string against = study.reference_run().run.method == "vof" ? "vof" : "reference";
  json& out = metrics["summary"];
  metrics["study"] = {{"title", study.study.title},
                      {"reference", study.study.reference},
                      {"strip_height_m", study.study.strip_height.value()}};
  for (Seconds t : study.study.snapshot_times)
    metrics["study"]["snapshot_times_s"].push_back(t.value());
  out["against"] = against;
  out["reference_label"] = study.reference().label();
  const json& timing = metrics["timing"][study.study.reference];
  out["reference_wall_s"] = timing.contains("wall_s") ? timing["wall_s"] : json();
  out["asked"] = study.runs.size();
  out["complete"] = std::count_if(study.runs.begin(), study.runs.end(), [](const RunResult& run) {
    return run.status == RunStatus::complete;
  });
  out["nearer"] = nullptr;
  for (const char* table : {"methods", "beyond"}) out[table] = json::object();
  std::set<std::string> processors;
  for (const RunResult* run : study.measured()) {
    const json& manifest = run->measured->run.manifest;
    if (manifest.is_object() && manifest.contains("cpu")) processors.insert(manifest["cpu"]);
  }
  out["processors"] = processors;
  if (!study.has_front) return;
  // Those that a publication compares are always told of, if only as missing.
  const Statement* accuracy = study.study.statements.of_rule("more_accurate");
  std::set<std::string> methods;
  if (accuracy != nullptr) methods.insert(accuracy->methods.begin(), accuracy->methods.end());
  for (const RunResult* run : study.measured())
    if (run != &study.reference()) methods.insert(run->measured->run.method);
  for (const std::string& method : methods) {
    for (const auto& [table, of_the_paper] : {std::pair{"methods", true}, {"beyond", false}}) {
      out[table][method] = entry_of(
          nearest_run(study, metrics, method, of_the_paper, "rms_vs_" + against), metrics, against);
    }
  }
  out["nearer"] = nullptr;
  if (accuracy == nullptr) return;
  out["statement"] = accuracy->text;
  for (const std::string& method : accuracy->methods) out["compared"].push_back(upper_case(method));
  const json& first = out["methods"][accuracy->methods.at(0)];
  const json& second = out["methods"][accuracy->methods.at(1)];
  if (first.is_null() || second.is_null()) return;
  const double a = first["rms"], b = second["rms"];
  out["nearer"] = out["compared"][a <= b ? 0 : 1];
  out["rms_ratio"] = std::max(a, b) > 0.0 ? std::min(a, b) / std::max(a, b) : 1.0;
}

}  // namespace surge::compare
