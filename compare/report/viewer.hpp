#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// What the viewer shows: a panel per run, one sequence of times for all.
struct ViewerPlan {
  std::vector<const RunResult*> runs;      ///< in the study's order
  std::vector<const RunResult*> left_out;  ///< measured, but not shown
  std::vector<Seconds> times;
};

/// The reference and the first run of each other method and preset, all times. Fewer times,
/// then fewer runs (the one with the most water goes first, never the reference) keep the text of
/// the data near `budget` bytes.
[[nodiscard]] ViewerPlan plan_viewer(const StudyResult& study, double budget = 12e6);

/// Edge of the squares on which the water of a mesh is shown, over L.
[[nodiscard]] double viewer_square(const Run& run);
/// The run whose files say what stands in the water: the reference before others.
[[nodiscard]] const Run& viewer_solid_run(const StudyResult& study, const ViewerPlan& plan);

/// Adds "viewer": times, the fronts at these times, the range of the colours, how many frames the
/// runs have, how far from its place a particle may be drawn ("position_error_over_spacing", each
/// coordinate), the plane that 3D is cut at ("slice": {"axis", "at_m"} or null), whether the tank
/// moves (the pictures are in its frame), and how many moving walls are not drawn because their law
/// is not known.
void measure_viewer(const StudyResult& study, nlohmann::json& metrics);
/// What the viewer draws from: its data, and the names of the measured runs that it leaves out.
[[nodiscard]] nlohmann::json viewer_json(const StudyResult& study, const nlohmann::json& metrics);

}  // namespace surge::compare
