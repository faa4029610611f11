#include "compare/report/claims.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

std::string evidence_cell(const Page& page, const std::string& claim) {
  std::string html;
  const json& evidence = page.values.at(claim + "/evidence");
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const std::string at = claim + "/evidence/" + std::to_string(i);
    html += (i ? "<br/>" : "") + page.values.text(at + "/what") + ": " +
            page.values.magnitude(at + "/value");
  }
  return evidence.size() > 4
             ? "<details><summary>" + page.values.integer(claim + "/evidence_count") +
                   " numbers</summary>" + html + "</details>"
             : html;
}

std::string claims_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < page.values.at("/claims").size(); ++i) {
    const std::string at = "/claims/" + std::to_string(i);
    rows.push_back({page.values.text(at + "/statement"),
                    "<strong>" + page.values.text(at + "/verdict") + "</strong>",
                    evidence_cell(page, at), page.values.text(at + "/criterion"),
                    page.values.text(at + "/place")});
  }
  return "<div class=\"words\">" +
         html_table("What the paper says of its results, and what these runs say to it",
                    {"Statement", "Verdict", "Measured", "Criterion", "In the paper"}, rows) +
         "</div>";
}

}  // namespace

void measure_claims(const StudyResult& study, json& metrics) {
  measure_runs_without_collisions(study, metrics);
  measure_scaling(study, metrics);  // its section comes later on the page
  measure_cost(study, metrics);
  json& out = metrics["claims"] = json::array();
  json& counts = metrics["claim_counts"];
  counts = {{"judged", 0}, {"reproduced", 0}, {"not reproduced", 0}, {"depends", 0}};
  for (const Claim& claim : find_claims(study, metrics)) {
    json evidence = json::array();
    for (const auto& [what, value] : claim.evidence)
      evidence.push_back({{"what", what}, {"value", value}});
    const std::string kind = claim.verdict.starts_with("depends") ? "depends" : claim.verdict;
    if (counts.contains(kind)) {
      for (const std::string& name : {std::string("judged"), kind})
        counts[name] = counts[name].get<int>() + 1;
    }
    out.push_back({{"id", claim.id},
                   {"statement", claim.statement},
                   {"place", claim.place},
                   {"criterion", claim.criterion},
                   {"verdict", claim.verdict},
                   {"evidence_count", evidence.size()},
                   {"evidence", evidence}});
  }
}

std::string write_claims(const Page& page) {
  return claims_table(page);
}

}  // namespace surge::compare
