#include "compare/report/claims.hpp"

#include "compare/report/claim_parts.hpp"

namespace surge::compare {

using nlohmann::json;

Runs complete_runs(const StudyResult& study, const std::string& method) {
  Runs runs;
  for (const RunResult* run : study.measured()) {
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

std::string verdict_of(std::size_t met, std::size_t all, const std::string& condition) {
  if (all == 0) return not_measured;
  if (met == all) return reproduced;
  return met == 0 ? not_reproduced : "depends on " + condition;
}

std::string upper_name(const std::string& method) {
  return method == "mps" ? "MPS" : "SPH";
}

PairCount compare_pairs(const Runs& mps, const Runs& sph,
                        const std::function<json(const RunResult&)>& value,
                        const std::function<bool(double mps, double sph)>& as_said) {
  PairCount count;
  for (const RunResult* a : mps) {
    for (const RunResult* b : sph) {
      const json of_mps = value(*a), of_sph = value(*b);
      if (!of_mps.is_number() || !of_sph.is_number()) continue;
      ++count.all;
      count.met += as_said(of_mps.get<double>(), of_sph.get<double>()) ? 1 : 0;
    }
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
