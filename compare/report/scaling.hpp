#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/report/study_result.hpp"

namespace surge::compare {

/// Adds metrics["scaling"]: per method and neighbour search the solving time over the number of
/// particles, from the study's timed runs, with fitted exponents. Empty where there are none.
void measure_scaling(const StudyResult& study, nlohmann::json& metrics);

}  // namespace surge::compare
