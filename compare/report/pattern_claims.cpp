#include <algorithm>
#include <optional>

#include "compare/report/claim_parts.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Of a run that is compared, or of a level.
json pattern_number(const json& metrics, const RunResult& run, const std::string& pointer) {
  const char* table = run.study.role == Role::convergence ? "pattern_levels" : "patterns";
  return number_of(metrics, table, run, pointer);
}

/// Whether runs of the first method, and only they, fragment at one strictness; empty where a
/// method is missing.
std::optional<Answer> only_first_fragments(const Judging& judging, std::size_t cohesion) {
  const auto& [study, metrics, statement] = judging;
  const std::string part = "/detached/" + std::to_string(cohesion) + "/part_mean";
  const ValueOf value = [&, &table = metrics](const RunResult& run) {
    return pattern_number(table, run, part);
  };
  const double threshold = statement.numbers.at("part");
  const Runs first = complete_runs(study, statement.methods.at(0));
  Runs others = complete_runs(study, statement.methods.at(1));
  others.push_back(&study.reference());
  const auto fragments = [&, &result = study](const RunResult& run) {
    const auto judged = judged_by_levels(result, run, value);
    return judged ? is_above(*judged, {threshold, 0.0}) : Answer::open;
  };
  if (first.empty() || others.size() < 2 || !value(study.reference()).is_number())
    return std::nullopt;
  Answer answer = Answer::yes;
  for (const auto& [runs, wanted] : {std::pair{first, Answer::yes}, {others, Answer::no}}) {
    for (const RunResult* run : runs) {
      const Answer said = fragments(*run);
      if (said == Answer::open) {
        answer = Answer::open;
      } else if (said != wanted) {
        return Answer::no;  // one is enough, whatever the others are
      }
    }
  }
  return answer;
}

/// Runs without particle collisions: of the comparison or of the sensitivity, however they ended.
Runs runs_without_collisions(const StudyResult& study) {
  Runs runs;
  for (const Role role : {Role::comparison, Role::sensitivity}) {
    for (const RunResult* run : study.runs_of(role)) {
      if (run->measured && run->measured->run.method == "mps" &&
          parameter_of(*run, "collision_distance") == 0.0)
        runs.push_back(run);
    }
  }
  return runs;
}

json closest(const json& metrics, const RunResult& run, const char* when) {
  return pattern_number(metrics, run, std::string("/smallest_distance_over_l0/") + when);
}

/// What happens in the runs in which nothing but the weight function keeps particles apart; empty
/// where they stay apart to the end.
std::string without_collisions(const json& metrics, const Runs& alone, double apart, Claim& claim) {
  std::string happens;
  for (const RunResult* run : alone) {
    const json ever = number_of(metrics, "without_collisions", *run, "/smallest_distance_over_l0");
    const json last = number_of(metrics, "without_collisions", *run, "/last_s");
    claim.evidence.push_back(
        {"smallest distance ever without collisions, " + run->study.name, ever});
    claim.evidence.push_back({"s simulated until its end, " + run->study.name, last});
    if (!ever.is_number() || ever.get<double>() < apart) return "without them they cluster";
    if (run->status != RunStatus::complete) happens = "without them the run breaks up";
  }
  return happens;
}

}  // namespace

void measure_runs_without_collisions(const StudyResult& study, json& metrics) {
  json& out = metrics["without_collisions"] = json::object();
  for (const RunResult* run : runs_without_collisions(study)) {
    std::optional<double> least;
    for (const PatternSample& sample : study.pattern(*run)) {
      if (sample.smallest_distance)
        least = std::min(least.value_or(*sample.smallest_distance), *sample.smallest_distance);
    }
    const auto last = run->last_time();
    out[run->study.name] = {{"smallest_distance_over_l0", least ? json(*least) : json()},
                            {"last_s", last ? json(last->value()) : json()},
                            {"status", status_text(run->status)}};
  }
}

Claim judge_patterns(const Judging& judging) {
  const auto& [study, metrics, statement] = judging;
  Claim claim = claim_of(statement);
  const Runs runs = complete_runs(study, statement);
  Count count;
  for (const char* when : {"before", "after"}) {
    const ValueOf mean = [&, &table = metrics](const RunResult& run) {
      return pattern_number(table, run, std::string("/overlap/") + when + "_mean");
    };
    add_evidence(claim, std::string(when) + " impact, ", runs, mean);
    count += count_above(
        runs,
        [&, &result = study](const RunResult& run) { return judged_by_levels(result, run, mean); },
        statement.numbers.at("overlap"));
  }
  claim.verdict = verdict_of(count, statement.condition);
  return claim;
}

Claim judge_fragmentation(const Judging& judging) {
  const auto& [study, metrics, statement] = judging;
  Claim claim = claim_of(statement);
  Count count;
  for (std::size_t c = 0; c < cohesion_count; ++c) {
    if (const auto said = only_first_fragments(judging, c)) count.add(*said);
    for (const RunResult* run : judged_runs(study)) {
      const bool mesh = run->measured->run.is_mesh();
      const std::string at = "/detached/" + std::to_string(c);
      const std::string rule = mesh ? "level " + fixed_text(corner_levels[c], 2)
                                    : "linking length " + fixed_text(linking_lengths[c], 1);
      claim.evidence.push_back({"part of the water, " + rule + ", " + run->label(),
                                number_of(metrics, "patterns", *run, at + "/part_mean")});
      claim.evidence.push_back({"pieces, " + rule + ", " + run->label(),
                                number_of(metrics, "patterns", *run, at + "/pieces_mean")});
    }
  }
  claim.verdict = verdict_of(count, statement.condition);
  return claim;
}

Claim judge_clustering(const Judging& judging) {
  const auto& [study, metrics, statement] = judging;
  Claim claim = claim_of(statement);
  const Runs apart = complete_runs(study, statement.methods.at(0));
  const Runs close = complete_runs(study, statement.methods.at(1));
  for (const char* when : {"median", "minimum"}) {
    const std::string what =
        std::string(when) == "median" ? "median smallest distance, " : "smallest distance ever, ";
    for (const Runs& runs : {apart, close})
      add_evidence(claim, what, runs, [&, &table = metrics](const RunResult& run) {
        return closest(table, run, when);
      });
  }
  add_evidence(claim, "collisions of particles, ", apart, [](const RunResult& run) {
    return number_at(run.manifest, json::json_pointer("/particle_collisions"));
  });
  const ValueOf median = [&table = metrics](const RunResult& run) {
    return closest(table, run, "median");
  };
  const Count count = count_pairs(apart, close, [&, &result = study](const RunResult& run) {
    return judged_by_levels(result, run, median);
  });
  const Runs alone = runs_without_collisions(study);
  const std::string happens =
      without_collisions(metrics, alone, statement.numbers.at("apart"), claim);
  claim.verdict = verdict_of(count, statement.condition);
  if (claim.verdict != reproduced) return claim;
  if (alone.empty())
    claim.verdict = "depends on the collisions between particles: no run of this study is without";
  else if (!happens.empty())
    claim.verdict = "depends on the collisions between particles: " + happens;
  return claim;
}

Claim judge_robustness(const Judging& judging) {
  const auto& [study, metrics, statement] = judging;
  Claim claim = claim_of(statement);
  Count count;
  for (const RunResult* run : judged_runs(study)) {
    const auto& methods = statement.methods;
    if (std::find(methods.begin(), methods.end(), run->measured->run.method) == methods.end() ||
        run == &study.reference())
      continue;
    const json lost = number_at(run->manifest, json::json_pointer("/lost_particles"));
    const json nonfinite = number_at(run->manifest, json::json_pointer("/nonfinite"));
    count.add(run->status == RunStatus::complete && lost == 0 && nonfinite == 0);
    claim.evidence.push_back({"lost, " + run->label(), lost});
    claim.evidence.push_back({"non-finite, " + run->label(), nonfinite});
  }
  claim.verdict = verdict_of(count, statement.condition);
  return claim;
}

}  // namespace surge::compare
