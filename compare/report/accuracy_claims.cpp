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

/// The nearer below the farther by more than the uncertainty of the difference, in all pairs. The
/// reference is the same for both, but its error may take from the one what it gives to the other.
Count count_accuracy(const StudyResult& study, const json& metrics, const Runs& nearer,
                     const Runs& farther) {
  Count count;
  for (const RunResult* a : nearer) {
    for (const RunResult* b : farther) {
      const json of_nearer = verdict_on(metrics, study, *a),
                 of_farther = verdict_on(metrics, study, *b);
      if (of_nearer.is_null() || of_farther.is_null()) continue;
      const json &u = of_nearer["u_run"], &w = of_farther["u_run"], &r = of_nearer["u_reference"];
      const double gain = of_farther["E"].get<double>() - of_nearer["E"].get<double>();
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

Claim judge_agreement(const Judging& judging) {
  const auto& [study, metrics, statement] = judging;
  Claim claim = claim_of(statement);
  const Runs runs = complete_runs(study, statement);
  add_evidence(claim, "RMS, ", runs, rms_against_reference(study, metrics));
  claim.verdict = verdict_of(count_verdicts(study, metrics, runs), statement.condition);
  return claim;
}

Claim judge_accuracy(const Judging& judging) {
  const auto& [study, metrics, statement] = judging;
  Claim claim = claim_of(statement);
  const Runs nearer = complete_runs(study, statement.methods.at(0));
  const Runs farther = complete_runs(study, statement.methods.at(1));
  const ValueOf rms = rms_against_reference(study, metrics);
  add_evidence(claim, "RMS, ", nearer, rms);
  add_evidence(claim, "RMS, ", farther, rms);
  claim.verdict = verdict_of(count_accuracy(study, metrics, nearer, farther), statement.condition);
  return claim;
}

}  // namespace surge::compare
