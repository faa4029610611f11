#include <cmath>

#include "compare/report/sections.hpp"
#include "compare/study/levels.hpp"
#include "particle/support/json.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

json levels_json(const FlowLevels& sequence) {
  json levels = json::array();
  const FlowResult* coarser = nullptr;
  for (const auto& level : sequence.levels) {
    const FlowResult& result = *level.result;
    json entry{{"run", level.run},
               {"spacing_m", result.flow.spacing},
               {"particles_over_L", result.flow.per_length()},
               {"error", result.error},
               {"order", nullptr},
               {"momentum", json_or_null(result.momentum)},
               {"energy", json_or_null(result.energy)},
               {"volume", json_or_null(result.volume)}};
    if (coarser != nullptr)
      entry["order"] = json_or_null(
          observed_order(coarser->flow.spacing, coarser->error, result.flow.spacing, result.error));
    for (const FlowMeasure& measure : result.measures)
      entry["measures"][measure.name] = json_or_null(measure.value);
    coarser = &result;
    levels.push_back(std::move(entry));
  }
  return levels;
}

/// The error at the bar's number of particles over L; null where there is no such run.
json bar_json(const KnownFlow& known, const FlowLevels& sequence) {
  for (const auto& level : sequence.levels) {
    if (std::abs(level.result->flow.per_length() - known.bar_per_length) > 1e-6) continue;
    const double error = level.result->error;
    return {{"error", error}, {"reached", error < *known.bar}};
  }
  return nullptr;
}

}  // namespace

void measure_verification(const StudyResult& study, json& metrics) {
  json& out = metrics["verification"];
  out = json::object();
  for (const KnownFlow& known : known_flows()) {
    const auto sequences = levels_of(study, known.group);
    if (sequences.empty()) continue;
    json& entry = out[known.group];
    entry = {{"title", known.title},
             {"error", known.error},
             {"bar", json_or_null(known.bar)},
             {"bar_per_length", known.bar_per_length},
             {"sequences", json::array()}};
    for (const FlowLevels& sequence : sequences) {
      json item{{"label", sequence.label},
                {"recommended", sequence.recommended},
                {"levels", levels_json(sequence)}};
      if (known.bar && sequence.recommended) item["bar"] = bar_json(known, sequence);
      entry["sequences"].push_back(std::move(item));
    }
  }
}

}  // namespace surge::compare
