#include <algorithm>
#include <array>
#include <cmath>

#include "compare/study/sequences.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// RMS of Z/L for which the cheapest run is named.
constexpr std::array<double, 6> accuracies{0.2, 0.1, 0.05, 0.03, 0.02, 0.01};

/// Seconds of the solver, without setup and the writing of frames, as in Fig. 9; zero where the
/// manifest does not say. VOF writes between its steps, and that counts.
double solving_seconds(const json& manifest) {
  if (!manifest.is_object() || !manifest.contains("wall_s")) return 0.0;
  const json& wall = manifest["wall_s"];
  return wall.value("total", 0.0) - wall.value("setup", 0.0) - wall.value("output", 0.0);
}

void add_points(const StudyResult& study, const Sequence& sequence, const RunResult& finest,
                json& points) {
  for (const auto* list : {&sequence.levels, &sequence.others}) {
    for (const SequenceLevel& level : *list) {
      const RunResult& run = *level.run;
      const double seconds = solving_seconds(run.manifest);
      // Nothing can be said of what the others are measured against, on however many threads.
      const bool same = sequence.vof && level.size <= finest.measured->run.spacing.value();
      if (same || seconds <= 0.0) continue;
      points.push_back(
          {{"run", run.study.name},
           {"label", run.label()},
           {"sequence", sequence.label},
           {"threads", run.study.threads},
           {"wall_s", seconds},
           {"rms", difference(run.measured->front, finest.measured->front, study.wall()).rms},
           {"front", false}});
    }
  }
}

/// Whether no point on as many threads is cheaper and nearer.
bool unbeaten(const json& point, const json& points) {
  return std::none_of(points.begin(), points.end(), [&](const json& other) {
    return (other["threads"] == 1) == (point["threads"] == 1) &&
           other["wall_s"] <= point["wall_s"] && other["rms"] <= point["rms"] &&
           (other["wall_s"] < point["wall_s"] || other["rms"] < point["rms"]);
  });
}

/// The cheapest run on one thread within each accuracy; null where none is.
json cheapest(const json& points) {
  json out = json::array();
  for (const double accuracy : accuracies) {
    const json* best = nullptr;
    for (const json& point : points) {
      if (point["threads"] != 1 || point["rms"] > accuracy) continue;
      if (best == nullptr || point["wall_s"] < (*best)["wall_s"]) best = &point;
    }
    out.push_back({{"rms", accuracy}, {"point", best ? *best : json()}});
  }
  return out;
}

/// Standard uncertainty of the finest VOF run over the followed times, as measure_differences()
/// has it for every run; null where it has none.
json reference_uncertainty(const json& metrics) {
  const json& runs = metrics["uncertainty"]["against_vof"];
  return runs.empty() ? json() : runs.front()["rms"]["u_D"];
}

}  // namespace

void measure_cost_and_error(const StudyResult& study, const std::vector<Sequence>& sequences,
                            json& metrics) {
  json& out = metrics["pareto"];
  out = {{"against", nullptr},
         {"reference_u", nullptr},
         {"points", json::array()},
         {"cheapest", json::array()}};
  const RunResult* finest = finest_vof_run(sequences);
  if (finest == nullptr) return;
  out["against"] = finest->label();
  out["reference_u"] = reference_uncertainty(metrics);
  json points = json::array();
  for (const Sequence& sequence : sequences)
    if (sequence.over_spacing) add_points(study, sequence, *finest, points);
  for (json& point : points) point["front"] = unbeaten(point, points);
  std::stable_sort(points.begin(), points.end(),
                   [](const json& a, const json& b) { return a["wall_s"] < b["wall_s"]; });
  out["cheapest"] = cheapest(points);
  out["points"] = std::move(points);
}

}  // namespace surge::compare
