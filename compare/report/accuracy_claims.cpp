#include "compare/report/claim_parts.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr double good_agreement = 0.05;  ///< in Z/L

ValueOf rms_against_reference(const StudyResult& study, const json& metrics) {
  const bool vof = study.reference_run().run.method == "vof";
  return [&metrics, vof](const RunResult& run) {
    return number_of(metrics, "front", run, vof ? "/rms_vs_vof" : "/rms_vs_reference");
  };
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
  const Runs runs = complete_runs(study, method);
  const ValueOf rms = rms_against_reference(study, metrics);
  add_evidence(claim, "RMS, ", runs, rms);
  claim.verdict = verdict_of(count_runs(runs, rms, [](double x) { return x <= good_agreement; }),
                             "the formulation: not all of the runs meet it");
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
  const ValueOf rms = rms_against_reference(study, metrics);
  add_evidence(claim, "RMS, ", mps, rms);
  add_evidence(claim, "RMS, ", sph, rms);
  claim.verdict = verdict_of(count_pairs(mps, sph, rms, std::less<>()), "the formulation");
  return claim;
}

}  // namespace surge::compare
