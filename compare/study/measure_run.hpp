#pragma once

#include "compare/study/metrics.hpp"
#include "compare/study/observables.hpp"
#include "compare/study/study.hpp"

namespace surge::compare {

/// What a study wants to know of one run.
struct MeasureRequest {
  std::optional<FrontOptions> front;  ///< empty: no leading edge
  bool pattern = false;
  WaterOfRun* reference = nullptr;  ///< what the water is compared with; null for the reference
  const std::vector<StudyObservable>* observables = nullptr;
};

/// Measures all of it in one pass over the run's frames, one in memory at a time. An observable
/// that fails has its failure in its findings. Throws surge::Error where the front or the pattern
/// fails.
[[nodiscard]] MeasuredRun measure_for_study(Run run, const MeasureRequest& request);

/// The observables that a study names; of one that names none those that the reference's case
/// declares, gauges, probes and force surfaces, and centre of mass, energies and volume.
[[nodiscard]] std::vector<StudyObservable> study_observables(const Study& study,
                                                             const Run& reference);

}  // namespace surge::compare
