#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/figures/gnuplot.hpp"
#include "compare/report/study_result.hpp"

namespace surge::compare {

/// Fig. 6: the geometry with its dimensions, from what the reference run says it computed.
[[nodiscard]] Figure geometry_figure(const StudyResult& study);
/// Fig. 7: the runs side by side at the study's snapshot times.
[[nodiscard]] Figure snapshot_figure(const StudyResult& study);
/// Fig. 8: Z/L over T, published series as measured, and the difference to the reference.
[[nodiscard]] Figure leading_edge_figure(const StudyResult& study);
/// Fig. 8 with each published series moved in time to where it fits the reference best.
[[nodiscard]] Figure shifted_leading_edge_figure(const StudyResult& study);

/// Fig. 9: solving time over the number of fluid particles, from the study's timed runs.
[[nodiscard]] Figure cost_figure(const StudyResult& study);

/// One entry of the catalogue; number as in the paper, and a name for `surge-compare figure NAME`.
struct FigureDefinition {
  std::string name;
  Figure (*make)(const StudyResult&);
};

/// All figures in the order of the paper.
[[nodiscard]] std::span<const FigureDefinition> all_figures();

/// The definitions that a user means by "8", "fig8" or "fig8_shifted". Throws Error where there
/// is no such figure, with the ones that there are.
[[nodiscard]] const FigureDefinition& find_figure(const std::string& name);

/// The window's end for the figures: T at which the reference is within the wall rule's distance
/// of the far wall; empty where it never is or no wall is known.
[[nodiscard]] std::optional<DimensionlessTime> window_end(const StudyResult& study);

}  // namespace surge::compare
