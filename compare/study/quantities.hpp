#pragma once

#include <optional>
#include <string>

#include "compare/study/metrics.hpp"

namespace surge::compare {

/// A number of a run by name: impact_time_s, spacing_m, column_width_m, gravity, finished (1 or 0),
/// or any number at the top of its manifest (lost_particles, nonfinite, steps, cells, ...). Empty
/// where the run has none or it is not finite.
[[nodiscard]] std::optional<double> scalar(const Run& run, const FrontHistory& front,
                                           const std::string& name);
[[nodiscard]] std::optional<double> scalar(const MeasuredRun& run, const std::string& name);

/// "1.5", "2.0": how levels of Z/L are called in files.
[[nodiscard]] std::string level_text(double level);

/// Rule for the end of a run's window.
[[nodiscard]] WallRule wall_rule(const Run& run, DimensionlessLength distance);

}  // namespace surge::compare
