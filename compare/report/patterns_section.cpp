#include "compare/report/claims.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

namespace {

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

/// A row per run and strictness of the rule.
std::string linking_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, entry] : page.values.at("/patterns").items()) {
    for (std::size_t c = 0; c < entry["detached"].size(); ++c) {
      const std::string at = key({"patterns", name, "detached", std::to_string(c)});
      const bool mesh = page.values.has(at + "/corner_level");
      rows.push_back(
          {page.values.text(key({"patterns", name, "label"})),
           mesh ? "volume fraction at the corners" : "linking length over spacing",
           page.values.number(at + "/threshold", 2), page.values.number(at + "/pieces_mean", 1),
           page.values.integer(at + "/pieces_maximum"), page.values.number(at + "/part_mean", 4),
           page.values.number(at + "/part_maximum", 4)});
    }
  }
  return html_table(
      "Detached water after the impact, by the rule that joins water to a piece",
      {"Run", "Rule", "", "Pieces, mean", "at most", "Part of the water, mean", "at most"}, rows);
}

}  // namespace

std::string write_patterns(const Page& page) {
  return "<p>The water of a run is compared with that of the reference in the square cells of one "
         "grid, as coarse as the coarser of the two: their common part over what either covers. "
         "Water hangs together where particles are no farther apart than the linking length, or "
         "where corners of the mesh are full enough; the largest piece is the main body, the "
         "others "
         "are detached.</p>\n" +
         figure_html(page, "patterns") + pattern_table(page) + linking_table(page);
}

}  // namespace surge::compare
