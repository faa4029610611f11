#pragma once

#include <nlohmann/json.hpp>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// Adds metrics["sensitivity"]: per method ("mps", "sph", "vof") the run of group "base" and, in
/// the study's order, the runs of role sensitivity that differ from it in one choice each: the
/// differences of their fronts to the study's reference and to the base over the windows they
/// share before the far wall, and their cost over the base's. Empty where the study has no base.
///
/// What a run varies is told by its settings that are not among the base's. The cost is in CPU
/// seconds, because such runs may share the machine. A run without a front has a note instead.
void measure_sensitivity(const StudyResult& study, nlohmann::json& metrics);

}  // namespace surge::compare
