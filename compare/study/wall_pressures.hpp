#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measure/wall_pressure.hpp"
#include "compare/study/study_result.hpp"

namespace surge::compare {

/// The pressure at the far wall that a run has recorded, as far as there is one.
struct WallPressureResult {
  const RunResult* run = nullptr;
  std::optional<Seconds> impact;  ///< when the run's own front is at the far wall
  std::optional<PressureSignal> signal;
  std::optional<ImpactPressure> found;
  std::string note;  ///< why something is missing
};

/// Of all measured runs of role comparison, in the study's order. None where the reference has no
/// probe on the wall; runs whose probe is elsewhere get a note.
[[nodiscard]] std::vector<WallPressureResult> wall_pressures(const StudyResult& study);

}  // namespace surge::compare
