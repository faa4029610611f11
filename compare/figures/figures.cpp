#include "compare/figures/figures.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "compare/figures/cost_to_error.hpp"
#include "compare/figures/differences.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

std::span<const FigureDefinition> all_figures() {
  static const std::array<FigureDefinition, 15> figures{
      {{"fig1", "weight", weight_figure},
       {"fig2", "interaction", interaction_figure},
       {"fig3", "mps_algorithm", mps_algorithm_figure},
       {"fig4", "kernel", kernel_figure},
       {"fig5", "sph_algorithm", sph_algorithm_figure},
       {"fig6", "geometry", geometry_figure},
       {"fig7", "snapshots", snapshot_figure},
       {"surfaces", "free_surfaces", surface_figure},
       {"patterns", "overlap", pattern_figure},
       {"fig8", "leading_edge", leading_edge_figure, true},
       {"fig8_shifted", "leading_edge_shifted", shifted_leading_edge_figure, true, true},
       {"fig9", "cost", cost_figure},
       {"sensitivity_mps", "mps", mps_sensitivity_figure, true},
       {"sensitivity_sph", "sph", sph_sensitivity_figure, true},
       {"sensitivity_vof", "vof", vof_sensitivity_figure, true}}};
  return figures;
}

std::string known_figures() {
  std::string known;
  for (const auto& figure : all_figures())
    known += (known.empty() ? "" : ", ") + figure.name + " (" + figure.word + ")";
  return known;
}

namespace {

/// Those that depend on what else a study has.
std::vector<Figure> further_figures(const StudyResult& study) {
  std::vector<Figure> figures;
  const auto add = [&](std::vector<Figure> more) {
    std::move(more.begin(), more.end(), std::back_inserter(figures));
  };
  if (study.has_reference()) {
    add(difference_figures(study));
    add(observable_figures(study));
    if (study.has_front) add(wall_pressure_figures(study));
    if (study.has_front) add(convergence_figures(study));
    add(cost_to_error_figures(study));
  }
  add(verification_figures(study));
  return figures;
}

/// "Motion of the leading edge" of "Fig. 8. Motion of the leading edge".
std::string without_number(const std::string& title) {
  if (!title.starts_with("Fig. ")) return title;
  const auto end = title.find_first_not_of("0123456789", 5);
  if (end == std::string::npos || title[end] == ',') return "Leading edge" + title.substr(end);
  return title.substr(title.find_first_not_of(". ", end));
}

}  // namespace

std::vector<Figure> figures_of(const StudyResult& study) {
  std::vector<Figure> figures;
  if (study.has_reference())
    for (const auto& definition : all_figures())
      if ((study.has_front || !definition.needs_front) &&
          (!study.published.empty() || !definition.needs_series))
        figures.push_back(definition.make(study));
  for (Figure& figure : further_figures(study)) figures.push_back(std::move(figure));
  // The numbers are those of the paper, which other studies have nothing to do with.
  if (!study.judges_paper())
    for (Figure& figure : figures) figure.title = without_number(figure.title);
  return figures;
}

const FigureDefinition* find_figure(const std::string& name) {
  const auto figures = all_figures();
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& figure) {
    return figure.name == name || figure.word == name || figure.name == "fig" + name;
  });
  return found == figures.end() ? nullptr : &*found;
}

Figure figure_of(const StudyResult& study, const std::string& name) {
  if (const FigureDefinition* definition = find_figure(name)) {
    if (!study.has_reference())
      throw Error("figure " + name + ": found a study without a reference run, expected one");
    if (definition->needs_front && !study.has_front)
      throw Error("figure " + name + ": found a study without a leading edge, expected one");
    if (definition->needs_series && study.published.empty())
      throw Error("figure " + name +
                  ": found a study without published series of the leading edge, expected some");
    return definition->make(study);
  }
  std::string known = study.has_reference() ? known_figures() : "";
  for (Figure& figure : further_figures(study)) {
    if (figure.name == name) return std::move(figure);
    known += (known.empty() ? "" : ", ") + figure.name;
  }
  throw Error("figure: found \"" + name + "\", expected one of " + known);
}

std::optional<DimensionlessTime> window_end(const StudyResult& study) {
  const auto limit = study.wall().limit();
  if (!limit) return std::nullopt;
  return study.reference_run().front.arrival(*limit);
}

}  // namespace surge::compare
