#include <cmath>

#include "compare/report/claim_parts.hpp"
#include "compare/study/sequences.hpp"
#include "compare/study/verdict.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// The verdict on a run's leading edge against the reference, in metrics["verdicts"].
json verdict_on(const json& metrics, const StudyResult& study, const RunResult& run) {
  json::json_pointer pointer("/verdicts/runs");
  pointer /= run.study.name;
  pointer /= "leading_edge";
  pointer /= study.study.reference;
  return number_at(metrics, pointer);
}

Count count_verdicts(const StudyResult& study, const json& metrics, const Runs& runs) {
  Count count;
  for (const RunResult* run : runs) {
    const json verdict = verdict_on(metrics, study, *run);
    if (verdict.is_null()) continue;
    if (verdict["verdict"] == outcome_text(Outcome::undecided)) {
      ++count.open;
    } else {
      count.add(verdict["verdict"] == outcome_text(Outcome::agrees));
    }
  }
  return count;
}

/// MPS below SPH by more than the uncertainty of the difference, in all pairs of runs. The
/// reference is the same for both, but its error may take from the one what it gives to the other.
Count count_accuracy(const StudyResult& study, const json& metrics, const Runs& mps,
                     const Runs& sph) {
  Count count;
  for (const RunResult* a : mps) {
    for (const RunResult* b : sph) {
      const json of_mps = verdict_on(metrics, study, *a), of_sph = verdict_on(metrics, study, *b);
      if (of_mps.is_null() || of_sph.is_null()) continue;
      const json &u = of_mps["u_run"], &w = of_sph["u_run"], &r = of_mps["u_reference"];
      const double gain = of_sph["E"].get<double>() - of_mps["E"].get<double>();
      const bool known = u.is_number() && w.is_number() && r.is_number();
      if (!known || std::abs(gain) <=
                        coverage * std::hypot(u.get<double>(), w.get<double>(), r.get<double>())) {
        ++count.open;
      } else {
        count.add(gain > 0.0);
      }
    }
  }
  return count;
}

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
                  fixed_text(front_tolerance, 2) +
                  " in every complete run of the method: a third of the uncertainty with which the "
                  "experiments can be read (0.15), and one cell of a mesh of 20 cells per L; "
                  "decided by the interval of the RMS, see the table of what can be decided",
              "",
              {}};
  const Runs runs = complete_runs(study, method);
  const ValueOf rms = rms_against_reference(study, metrics);
  add_evidence(claim, "RMS, ", runs, rms);
  claim.verdict = verdict_of(count_verdicts(study, metrics, runs),
                             "the formulation: not all of the runs meet it");
  return claim;
}

Claim accuracy_claim(const StudyResult& study, const json& metrics) {
  Claim claim{
      "mps_more_accurate",
      "MPS is more accurate than SPH in the leading edge.",
      "Section 5.1, Fig. 8",
      "RMS of every MPS run below that of every SPH run by more than the uncertainty of the "
      "difference",
      "",
      {}};
  const Runs mps = complete_runs(study, "mps"), sph = complete_runs(study, "sph");
  const ValueOf rms = rms_against_reference(study, metrics);
  add_evidence(claim, "RMS, ", mps, rms);
  add_evidence(claim, "RMS, ", sph, rms);
  claim.verdict = verdict_of(count_accuracy(study, metrics, mps, sph), "the formulation");
  return claim;
}

}  // namespace surge::compare
