#include "compare/report/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/report/claim_parts.hpp"
#include "compare/study/sequences.hpp"
#include "compare/study/verdict.hpp"
#include "particle/support/bounds.hpp"

namespace surge::compare {

using nlohmann::json;

bool is_of_the_paper(const StudyResult& study, const RunResult& run) {
  const std::string& preset = run.measured->run.preset;
  return preset.empty() || study.study.statements.is_about(preset);
}

Runs judged_runs(const StudyResult& study) {
  Runs runs = study.measured();
  std::erase_if(runs, [&](const RunResult* run) { return !is_of_the_paper(study, *run); });
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

Runs complete_runs(const StudyResult& study, const Statement& statement) {
  Runs runs;
  for (const std::string& method : statement.methods)
    for (const RunResult* run : complete_runs(study, method)) runs.push_back(run);
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

std::string verdict_of(const Count& count, const std::string& condition) {
  if (count.open > 0) return not_decidable;
  if (count.all == 0) return not_measured;
  if (count.met == count.all) return reproduced;
  return count.met == 0 ? not_reproduced : "depends on " + condition;
}

void add_evidence(Claim& claim, const std::string& what, const Runs& runs, const ValueOf& value) {
  for (const RunResult* run : runs) claim.evidence.push_back({what + run->label(), value(*run)});
}

Answer is_above(const Judged& a, const Judged& b) {
  if (!a.interval || !b.interval) return Answer::open;
  const double apart = a.value - b.value;
  if (std::abs(apart) <= std::hypot(*a.interval, *b.interval)) return Answer::open;
  return apart > 0.0 ? Answer::yes : Answer::no;
}

std::optional<Judged> judged_by_levels(const StudyResult& study, const RunResult& run,
                                       const ValueOf& value) {
  std::vector<LevelValue> levels;
  std::optional<std::size_t> own;
  for (const RunResult* level : refinements_of(study, run)) {
    const json found = value(*level);
    if (!found.is_number()) continue;
    if (level == &run) own = levels.size();
    levels.push_back({level->measured->run.spacing.value(), found.get<double>()});
  }
  if (!own) return std::nullopt;
  const auto u = level_uncertainty(levels, *own);
  return Judged{levels[*own].value,
                u ? std::optional(coverage * *u / numerical_coverage) : std::nullopt};
}

Count count_above(const Runs& runs, const JudgedOf& number, double threshold) {
  Count count;
  for (const RunResult* run : runs)
    if (const auto known = number(*run)) count.add(is_above(*known, {threshold, 0.0}));
  return count;
}

Count count_pairs(const Runs& above, const Runs& below, const JudgedOf& number) {
  Count count;
  for (const RunResult* run : above) {
    const auto a = number(*run);
    if (!a) continue;
    for (const RunResult* other : below)
      if (const auto b = number(*other)) count.add(is_above(*a, *b));
  }
  return count;
}

Claim claim_of(const Statement& statement) {
  std::map<std::string, double> numbers = statement.numbers;
  numbers.emplace("tolerance", front_tolerance);
  std::string criterion = statement.criterion;
  for (const auto& [name, value] : numbers) {
    const std::string word = "{" + name + "}";
    for (auto at = criterion.find(word); at != std::string::npos; at = criterion.find(word))
      criterion.replace(at, word.size(), number_text(value));
  }
  return {statement.id, statement.text, statement.place, criterion, "", {}};
}

std::vector<Claim> find_claims(const StudyResult& study, const json& metrics) {
  using Rule = Claim (*)(const Judging&);
  static const std::map<std::string, Rule> rules{
      {"agrees", judge_agreement},
      {"more_accurate", judge_accuracy},
      {"alike", judge_patterns},
      {"only_fragments", judge_fragmentation},
      {"cheaper", judge_cost},
      {"pressure_takes", judge_pressure},
      {"grows", judge_growth},
      {"keeps_apart", judge_clustering},
      {"comes_to_end", judge_robustness},
  };
  std::vector<Claim> claims;
  for (const Statement& statement : study.study.statements.claims)
    claims.push_back(rules.at(statement.rule)({study, metrics, statement}));
  return claims;
}

}  // namespace surge::compare
