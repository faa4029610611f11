#include "compare/figures/figures.hpp"

#include <algorithm>
#include <array>

#include "particle/support/error.hpp"

namespace surge::compare {

std::span<const FigureDefinition> all_figures() {
  static const std::array<FigureDefinition, 5> figures{
      {{"fig6", geometry_figure},
       {"fig7", snapshot_figure},
       {"fig8", leading_edge_figure},
       {"fig8_shifted", shifted_leading_edge_figure},
       {"fig9", cost_figure}}};
  return figures;
}

const FigureDefinition& find_figure(const std::string& name) {
  const auto figures = all_figures();
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& figure) {
    return figure.name == name || figure.name == "fig" + name;
  });
  if (found != figures.end()) return *found;
  std::string known;
  for (const auto& figure : figures) known += (known.empty() ? "" : ", ") + figure.name;
  throw Error("figure: found \"" + name + "\", expected one of " + known);
}

std::optional<DimensionlessTime> window_end(const StudyResult& study) {
  const auto limit = study.wall().limit();
  if (!limit) return std::nullopt;
  return study.reference_run().front.arrival(*limit);
}

}  // namespace surge::compare
