#pragma once

#include <nlohmann/json.hpp>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// Adds metrics["scaling"]: per method, neighbour search and pressure solver the solving time over
/// the number of particles, from the study's runs of role timing, with fitted exponents. Empty
/// where there are none.
///
/// Two kinds of runs make a curve: whole ones, which reach the end of the reference, and windows,
/// which end early. Time per step is compared by the windows, which every size has. The total time
/// is measured where there is a whole run; else it is extrapolated, and marked:
///   total = (window's time per step) (whole / window) steps,
/// with the ratio of the times per step at the curve's largest size that has both, and the number
/// of steps of the largest whole run of the method, carried to the spacing by a fitted power.
void measure_scaling(const StudyResult& study, nlohmann::json& metrics);

}  // namespace surge::compare
