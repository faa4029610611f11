#include "compare/report/sections.hpp"

#include <array>

#include "compare/report/claims.hpp"
#include "compare/report/viewer.hpp"

namespace surge::compare {

std::span<const Section> report_sections() {
  static const std::array<Section, 15> sections{
      {{"summary", "", measure_summary, write_summary},
       {"viewer", "The flow in motion", measure_viewer, write_viewer},
       {"figures", "Figures", measure_figures, write_figures},
       {"flow", "Flow patterns and fragments", measure_patterns, write_patterns},
       {"pressure", "Wall pressure at the impact", measure_wall_pressure, write_wall_pressure},
       {"claims", "The paper’s statements", measure_claims, write_claims},
       {"scaling", "Cost over the number of particles", measure_scaling, write_scaling},
       {"sensitivity", "What the paper leaves open", measure_sensitivity, write_sensitivity},
       {"convergence", "Convergence, uncertainty, and error over cost", measure_convergence,
        write_convergence},
       {"verification", "Flows with a known answer", measure_verification, write_verification,
        false},
       {"runs", "Runs, accuracy and cost", measure_runs, write_runs},
       {"experiments", "Published series", measure_nothing, write_experiments},
       {"deviations", "Where the runs depart from the paper", measure_deviations, write_deviations},
       {"errata", "Where the paper errs", measure_errata, write_errata},
       {"provenance", "Provenance", measure_provenance, write_provenance, false}}};
  return sections;
}

void measure_nothing(const StudyResult&, nlohmann::json&) {}

std::string figure_html(const Page& page, const std::string& name) {
  for (const Figure& figure : page.figures) {
    if (figure.name != name) continue;
    const bool wide = figure.width_mm > single_column_mm;
    std::string html = "<figure id=\"" + name + "\" class=\"" + (wide ? "double" : "single") +
                       "\">\n<div class=\"scroll\">" +
                       inline_svg(page.figure_folder / (name + ".svg"), name, figure.title) +
                       "</div>\n<figcaption><strong>" + escape(figure.title) + ".</strong> " +
                       escape(figure.caption) + " Files:";
    for (const char* ending : {"svg", "pdf", "gp"}) {
      html += " <a href=\"figures/" + name + '.' + ending + "\">" + ending + "</a>";
    }
    for (const auto& table : figure.tables) {
      html += " <a href=\"figures/" + table.name + ".csv\">" + table.name + ".csv</a>";
    }
    return html + "</figcaption>\n</figure>\n";
  }
  return "";
}

}  // namespace surge::compare
