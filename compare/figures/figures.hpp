#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compare/figures/gnuplot.hpp"
#include "compare/study/study_result.hpp"

namespace surge::compare {

/// Fig. 1: the weight function of MPS, sampled by the program that ran with it.
[[nodiscard]] Figure weight_figure(const StudyResult& study);
/// Fig. 2: a particle of a real frame and its neighbours.
[[nodiscard]] Figure interaction_figure(const StudyResult& study);
/// Figs. 3 and 5: what a step of the solvers calls.
[[nodiscard]] Figure mps_algorithm_figure(const StudyResult& study);
[[nodiscard]] Figure sph_algorithm_figure(const StudyResult& study);
/// Fig. 4: the kernel of SPH and its derivative, sampled like Fig. 1.
[[nodiscard]] Figure kernel_figure(const StudyResult& study);
/// Fig. 6: the geometry with its dimensions, from what the reference run says it computed.
[[nodiscard]] Figure geometry_figure(const StudyResult& study);
/// The set-up of any other case: tank, water, obstacles, walls that move, probes and gauges; in 3D
/// from the side and from above.
[[nodiscard]] Figure setup_figure(const StudyResult& study);
/// Fig. 7: the runs side by side at the study's snapshot times.
[[nodiscard]] Figure snapshot_figure(const StudyResult& study);
/// The free surfaces of all runs, a panel for each of the study's snapshot times.
[[nodiscard]] Figure surface_figure(const StudyResult& study);
/// Overlap with the reference and detached water over time, with the effect of the linking length.
[[nodiscard]] Figure pattern_figure(const StudyResult& study);
/// Fig. 8: Z/L over T, published series as measured, and the difference to the reference.
[[nodiscard]] Figure leading_edge_figure(const StudyResult& study);
/// Fig. 8 with each published series moved in time to where it fits the reference best.
[[nodiscard]] Figure shifted_leading_edge_figure(const StudyResult& study);

/// Fig. 9: solving time over the number of fluid particles, from the study's timed runs.
[[nodiscard]] Figure cost_figure(const StudyResult& study);

/// A figure for each flow with a known answer of which the study has runs.
[[nodiscard]] std::vector<Figure> verification_figures(const StudyResult& study);
/// What the choices that the paper leaves open do to the front and the cost of a method, from the
/// study's runs of role sensitivity.
[[nodiscard]] Figure mps_sensitivity_figure(const StudyResult& study);
[[nodiscard]] Figure sph_sensitivity_figure(const StudyResult& study);
[[nodiscard]] Figure vof_sensitivity_figure(const StudyResult& study);

/// Pressure on the far wall at the impact, a panel per run over the reference; none where the
/// reference has no probe there.
[[nodiscard]] std::vector<Figure> wall_pressure_figures(const StudyResult& study);

/// Z/L over the spacing with the extrapolated values; none where the study has no runs of role
/// convergence.
[[nodiscard]] std::vector<Figure> convergence_figures(const StudyResult& study);

/// One for each curve of each observable, with all runs, references and their uncertainty.
[[nodiscard]] std::vector<Figure> observable_figures(const StudyResult& study);

/// One entry of the catalogue.
struct FigureDefinition {
  std::string name;  ///< "fig8"; its files', and `surge-compare figure 8` finds it
  std::string word;  ///< another name, for those who do not know the paper's numbers
  Figure (*make)(const StudyResult&);
  bool needs_front = false;   ///< shows the leading edge
  bool needs_series = false;  ///< shows published series of it
};

/// All figures in the order of the paper.
[[nodiscard]] std::span<const FigureDefinition> all_figures();

/// Those of the paper where the study has a reference run, and those of the known flows.
[[nodiscard]] std::vector<Figure> figures_of(const StudyResult& study);

/// "fig1 (weight), fig2 (interaction), ...": the catalogue.
[[nodiscard]] std::string known_figures();

/// The definition that a user means by "8", "fig8" or "leading_edge"; null where there is none.
[[nodiscard]] const FigureDefinition* find_figure(const std::string& name);

/// The figure of that name: one of the catalogue, or of those that a study has by its runs, as
/// "wall_pressure" or "verification_standing_wave". Throws Error where it has no such figure, with
/// the ones that there are.
[[nodiscard]] Figure figure_of(const StudyResult& study, const std::string& name);

/// The window's end for the figures: T at which the reference is within the wall rule's distance
/// of the far wall; empty where it never is or no wall is known.
[[nodiscard]] std::optional<DimensionlessTime> window_end(const StudyResult& study);

}  // namespace surge::compare
