#include "compare/report/claim_parts.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr double good_agreement = 0.05;  ///< in Z/L

json rms_of(const StudyResult& study, const json& metrics, const RunResult& run) {
  const bool vof = study.reference_run().run.method == "vof";
  return number_of(metrics, "front", run, vof ? "/rms_vs_vof" : "/rms_vs_reference");
}

}  // namespace

Claim agreement_claim(const StudyResult& study, const json& metrics, const std::string& method) {
  Claim claim{"leading_edge_" + method,
              "The leading edge of " + upper_name(method) + " is in good agreement with VOF.",
              "Section 5.1, Fig. 8",
              "RMS of the difference in Z/L before the far wall at most " +
                  fixed_text(good_agreement, 2) +
                  " in every complete run of the method: a third of the uncertainty with which the "
                  "experiments can be read (0.15), and one cell of a mesh of 20 cells per L",
              "",
              {}};
  std::size_t met = 0;
  const Runs runs = complete_runs(study, method);
  for (const RunResult* run : runs) {
    const json rms = rms_of(study, metrics, *run);
    met += rms.is_number() && rms.get<double>() <= good_agreement ? 1 : 0;
    claim.evidence.push_back({"RMS, " + run->label(), rms});
  }
  claim.verdict = verdict_of(met, runs.size(), "the formulation: not all of the runs meet it");
  return claim;
}

Claim accuracy_claim(const StudyResult& study, const json& metrics) {
  Claim claim{"mps_more_accurate",
              "MPS is more accurate than SPH in the leading edge.",
              "Section 5.1, Fig. 8",
              "RMS of every MPS run below that of every SPH run",
              "",
              {}};
  const Runs mps = complete_runs(study, "mps"), sph = complete_runs(study, "sph");
  for (const Runs& runs : {mps, sph}) {
    for (const RunResult* run : runs)
      claim.evidence.push_back({"RMS, " + run->label(), rms_of(study, metrics, *run)});
  }
  const PairCount count = compare_pairs(
      mps, sph, [&](const RunResult& run) { return rms_of(study, metrics, run); },
      [](double of_mps, double of_sph) { return of_mps < of_sph; });
  claim.verdict = verdict_of(count.met, count.all, "the formulation");
  return claim;
}

}  // namespace surge::compare
