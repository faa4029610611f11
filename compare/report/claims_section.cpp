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
  return evidence.size() > 6
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

std::string pattern_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, entry] : page.values.at("/patterns").items()) {
    const std::string at = key({"patterns", name});
    const auto usual = at + "/detached/" + std::to_string(usual_cohesion);
    const bool particles = page.values.has(at + "/smallest_distance_over_l0");
    rows.push_back(
        {page.values.text(at + "/label"), page.values.number(at + "/overlap/before_mean", 3),
         page.values.number(at + "/overlap/after_mean", 3),
         page.values.number(usual + "/pieces_mean", 1), page.values.number(usual + "/part_mean", 4),
         page.values.number(usual + "/part_maximum", 4),
         page.values.number(usual + "/blurred_mean", 4),
         particles ? page.values.number(at + "/smallest_distance_over_l0/minimum", 3) : "–",
         particles ? page.values.number(at + "/smallest_distance_over_l0/median", 3) : "–"});
  }
  return html_table(
      "Flow patterns; detached water and pieces are means after the impact",
      {"Run", "Overlap before impact", "after", "Pieces", "Part detached", "at most",
       "Part in cells too empty", "Smallest distance over spacing, ever", "median over time"},
      rows);
}

}  // namespace

void measure_claims(const StudyResult& study, json& metrics) {
  measure_patterns(study, metrics);
  measure_runs_without_collisions(study, metrics);
  measure_cost(study, metrics);
  json& out = metrics["claims"] = json::array();
  for (const Claim& claim : find_claims(study, metrics)) {
    json evidence = json::array();
    for (const auto& [what, value] : claim.evidence)
      evidence.push_back({{"what", what}, {"value", value}});
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
  return claims_table(page) + pattern_table(page);
}

}  // namespace surge::compare
