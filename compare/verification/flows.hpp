#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/verification/flow_run.hpp"

namespace surge::compare {

/// A measured curve beside the exact one, over the same x; NaN where none is known.
struct FlowCurve {
  struct Point {
    double x, measured, exact;
  };
  std::string name;
  std::vector<Point> points;
};

/// A named number of a flow, over a scale that the flow's description gives.
struct FlowMeasure {
  std::string name;
  double value;
};

/// What a run of a flow with a known answer comes to.
struct FlowResult {
  FlowCase flow;
  double error = 0.0;                 ///< the flow's one number, over its scale
  std::vector<FlowMeasure> measures;  ///< others
  std::vector<FlowCurve> curves;
  // What must not change, or must change as the exact solution does; empty where neither is known.
  std::optional<double> momentum, energy, volume;
};

/// A flow with a known answer.
struct KnownFlow {
  std::string group;  ///< name in studies
  std::string title;
  std::string setup;  ///< what is computed, and against what: plain text
  std::string error;  ///< what the error is
  std::string x_axis, y_axis;
  std::optional<double> bar;    ///< the error that recommended presets are to stay below ...
  double bar_per_length = 0.0;  ///< ... at this many particles over L
  bool points = false;          ///< draw particles rather than a line
  FlowResult (*measure)(const FlowCase&, const std::vector<ParticleFrame>&);
};

[[nodiscard]] std::span<const KnownFlow> known_flows();

/// Measures a run's folder. Throws Error for a group that is not known, a run whose case is not the
/// flow's, and unreadable files.
[[nodiscard]] FlowResult measure_flow(const std::string& group, const std::filesystem::path& folder,
                                      const nlohmann::json& manifest);

/// log(e1/e2)/log(h1/h2), the order at which an error falls with the spacing; empty where one of
/// them is not positive.
[[nodiscard]] std::optional<double> observed_order(double coarse_spacing, double coarse_error,
                                                   double fine_spacing, double fine_error);

}  // namespace surge::compare
