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

/// The reference and the first run of each other method and preset, at most 100 times. Fewer times,
/// then fewer runs (the one with the most water goes first, never the reference) keep the text of
/// the data near `budget` bytes.
[[nodiscard]] ViewerPlan plan_viewer(const StudyResult& study, double budget = 6e6);

/// Adds "viewer": times, the fronts at these times and the range of the colours.
void measure_viewer(const StudyResult& study, nlohmann::json& metrics);
/// What the viewer draws from: its data, and the names of the measured runs that it leaves out.
[[nodiscard]] nlohmann::json viewer_json(const StudyResult& study, const nlohmann::json& metrics);

}  // namespace surge::compare
