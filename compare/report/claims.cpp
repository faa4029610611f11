#include "compare/report/claims.hpp"

#include "compare/report/claim_parts.hpp"

namespace surge::compare {

using nlohmann::json;

bool is_of_the_paper(const RunResult& run) {
  const std::string& preset = run.measured->run.preset;
  return preset.empty() || preset.starts_with("paper");
}

Runs judged_runs(const StudyResult& study) {
  Runs runs = study.measured();
  std::erase_if(runs, [](const RunResult* run) { return !is_of_the_paper(*run); });
  return runs;
}

Runs complete_runs(const StudyResult& study, const std::string& method) {
  Runs runs;
  for (const RunResult* run : judged_runs(study)) {
    if (run != &study.reference() && run->status == RunStatus::complete && run->note.empty() &&
        run->measured->run.method == method)
      runs.push_back(run);
  }
  return runs;
}

json number_at(const json& from, const json::json_pointer& pointer) {
  return from.contains(pointer) ? from.at(pointer) : json();
}

json number_of(const json& metrics, const char* table, const RunResult& run,
               const std::string& pointer) {
  json::json_pointer whole;
  whole /= table;
  whole /= run.study.name;
  return number_at(metrics, whole / json::json_pointer(pointer));
}

json parameter_of(const RunResult& run, const std::string& name) {
  json::json_pointer pointer("/case/method/parameters");
  return number_at(run.manifest, pointer / name);
}

std::string upper_name(const std::string& method) {
  return method == "mps" ? "MPS" : "SPH";
}

std::string verdict_of(const Count& count, const std::string& condition) {
  if (count.open > 0) return not_decidable;
  if (count.all == 0) return not_measured;
  if (count.met == count.all) return reproduced;
  return count.met == 0 ? not_reproduced : "depends on " + condition;
}

void add_evidence(Claim& claim, const std::string& what, const Runs& runs, const ValueOf& value) {
  for (const RunResult* run : runs) claim.evidence.push_back({what + run->label(), value(*run)});
}

Count count_runs(const Runs& runs, const ValueOf& value, const std::function<bool(double)>& meets) {
  Count count;
  for (const RunResult* run : runs) {
    const json known = value(*run);
    if (known.is_number()) count.add(meets(known.get<double>()));
  }
  return count;
}

Count count_pairs(const Runs& mps, const Runs& sph, const ValueOf& value,
                  const std::function<bool(double mps, double sph)>& as_said) {
  Count count;
  for (const RunResult* run : mps) {
    const json of_mps = value(*run);
    if (!of_mps.is_number()) continue;
    count += count_runs(sph, value, [&](double of_sph) { return as_said(of_mps, of_sph); });
  }
  return count;
}

std::vector<Claim> find_claims(const StudyResult& study, const json& metrics) {
  return {agreement_claim(study, metrics, "mps"), agreement_claim(study, metrics, "sph"),
          accuracy_claim(study, metrics),         pattern_claim(study, metrics),
          fragmentation_claim(study, metrics),    cost_claim(study, metrics),
          pressure_claim(study, metrics),         growth_claim(metrics),
          clustering_claim(study, metrics),       robustness_claim(study)};
}

}  // namespace surge::compare
