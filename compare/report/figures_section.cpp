#include <algorithm>
#include <array>

#include "compare/figures/method.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Figures that stand in another section, and where.
constexpr std::array<std::array<const char*, 3>, 3> elsewhere{
    {{"wall_pressure", "The figure of the wall pressure", "below, with its table"},
     {"patterns", "The figure of the flow patterns", "below, with its tables"},
     {"fig8", "Fig. 8, motion of the leading edge", "in the summary"}}};

json interaction_json(const StudyResult& study) {
  const auto found = find_interaction(study);
  if (!found) return nullptr;
  json out{{"run", found->run->study.name},
           {"time_s", found->time.value()},
           {"position_m", found->position},
           {"radii", json::array()}};
  for (std::size_t k = 0; k < found->radii_over_l0.size(); ++k) {
    out["radii"].push_back(
        {{"over_l0", found->radii_over_l0[k]}, {"neighbours", found->neighbours[k]}});
  }
  return out;
}

}  // namespace

void measure_figures(const StudyResult& study, json& metrics) {
  metrics["interaction"] = interaction_json(study);
  for (const auto& [name, what, where] : elsewhere) metrics["figures_elsewhere"][name] = what;
}

std::string write_figures(const Page& page) {
  std::string html = "<div class=\"figures\">\n";
  for (const Figure& figure : page.figures) {
    // The flows with a known answer, the sensitivity and the convergence have sections of their
    // own.
    if (figure.name.starts_with("verification_") || figure.name.starts_with("sensitivity_") ||
        figure.name.starts_with("convergence"))
      continue;
    const auto other = std::find_if(elsewhere.begin(), elsewhere.end(),
                                    [&](const auto& e) { return figure.name == e[0]; });
    html += other == elsewhere.end()
                ? figure_html(page, figure.name)
                : "<p class=\"elsewhere\"><a href=\"#" + figure.name + "\">" +
                      page.values.text(key({"figures_elsewhere", figure.name})) + "</a> stands " +
                      (*other)[2] + ".</p>\n";
  }
  return html + "</div>\n";
}

}  // namespace surge::compare
