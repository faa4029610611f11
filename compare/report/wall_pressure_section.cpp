#include "compare/report/sections.hpp"
#include "compare/study/wall_pressures.hpp"

namespace surge::compare {

using nlohmann::json;

void measure_wall_pressure(const StudyResult& study, json& metrics) {
  json& out = metrics["wall_pressure"] = json::object();
  const auto results = wall_pressures(study);
  if (results.empty()) return;
  const Physics& physics = study.reference_run().run.physics;
  out = {{"height_m", (*wall_probe(study.reference_run().run))[1] - physics.floor()},
         {"sensor_interval_s", sensor_interval.value()},
         {"noise_interval_s", noise_interval.value()},
         {"readable_noise", readable_noise},
         {"window_T", impact_duration.value()},
         {"rho_g_H_Pa", pressure_scale(physics) ? json(*pressure_scale(physics)) : json()},
         {"runs", json::object()}};
  for (const WallPressureResult& result : results) {
    json entry{{"label", result.run->label()}, {"note", result.note},     {"peak", nullptr},
               {"peak_after_T", nullptr},      {"impulse", nullptr},      {"noise", nullptr},
               {"readable_from_T", nullptr},   {"median_step_s", nullptr}};
    if (result.found) {
      entry["peak"] = result.found->peak;
      entry["peak_after_T"] = result.found->time_of_peak.value();
      entry["impulse"] = result.found->impulse;
      entry["noise"] = result.found->noise;
      if (result.found->readable_from)
        entry["readable_from_T"] = result.found->readable_from->value();
    }
    if (result.impact) {
      const Scales scales = result.run->measured->run.physics.scales();
      const auto step = result.signal->median_step(
          result.impact->value(), (*result.impact + scales.dimensional(impact_duration)).value());
      if (step) entry["median_step_s"] = *step;
    }
    out["runs"][result.run->study.name] = entry;
  }
}

}  // namespace surge::compare
