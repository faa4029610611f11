#include "compare/report/claim_parts.hpp"
#include "compare/report/claims.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

void measure_claims(const StudyResult& study, json& metrics) {
  measure_runs_without_collisions(study, metrics);
  measure_cost(study, metrics);
  const Statement* accuracy = study.study.statements.of_rule("more_accurate");
  json& out = metrics["claims"] = json::array();
  json& counts = metrics["claim_counts"];
  counts = {
      {"judged", 0}, {"reproduced", 0}, {"not reproduced", 0}, {"depends", 0}, {not_decidable, 0}};
  for (const Claim& claim : find_claims(study, metrics)) {
    json evidence = json::array();
    for (const auto& [what, value] : claim.evidence)
      evidence.push_back({{"what", what}, {"value", value}});
    const std::string kind = claim.verdict.starts_with("depends") ? "depends" : claim.verdict;
    if (counts.contains(kind)) {
      for (const std::string& name : {std::string("judged"), kind})
        counts[name] = counts[name].get<int>() + 1;
    }
    // What the summary says of it must be the same.
    if (accuracy != nullptr && claim.id == accuracy->id)
      metrics["summary"]["accuracy"] = claim.verdict;
    out.push_back({{"id", claim.id},
                   {"statement", claim.statement},
                   {"place", claim.place},
                   {"criterion", claim.criterion},
                   {"verdict", claim.verdict},
                   {"evidence_count", evidence.size()},
                   {"evidence", evidence}});
  }
}

}  // namespace surge::compare
