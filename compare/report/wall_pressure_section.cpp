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

std::string write_wall_pressure(const Page& page) {
  if (page.values.at("/wall_pressure").empty()) return "";
  std::vector<std::vector<std::string>> rows;
  std::string notes;
  for (const auto& [name, entry] : page.values.at("/wall_pressure/runs").items()) {
    const std::string at = key({"wall_pressure", "runs", name});
    const Values& v = page.values;
    rows.push_back({v.text(at + "/label"), v.number(at + "/peak", 2),
                    v.number(at + "/peak_after_T", 2), v.number(at + "/impulse", 3),
                    v.number(at + "/noise", 3), v.number(at + "/readable_from_T", 2),
                    v.number(at + "/median_step_s", 6)});
    if (!entry["note"].get_ref<const std::string&>().empty())
      notes += "<p>" + v.text(at + "/label") + ": " + v.text(at + "/note") + ".</p>\n";
  }
  const Values& v = page.values;
  return "<p>The pressure on the far wall, " + v.number("/wall_pressure/height_m", 4) +
         " m above the floor, as a sensor would write it: a mean over its sampling interval of " +
         v.number("/wall_pressure/sensor_interval_s", 5) +
         " s, and no other filter. Where a run’s steps are longer than that, values between them "
         "are on a straight line. The impact lasts from the moment when the run’s own front is at "
         "the wall until " +
         v.number("/wall_pressure/window_T", 1) +
         " later in T. Noise is the root mean square of the difference between the signal and its "
         "moving mean over " +
         v.number("/wall_pressure/noise_interval_s", 3) +
         " s; the rise of the load itself is part of it, so that no run has none. A signal is "
         "called readable from the time on after which the noise within every such interval stays "
         "below " +
         v.number("/wall_pressure/readable_noise", 1) +
         " of the largest moving mean; a dash: never in this window. Pressures are over the weight "
         "of the column, " +
         v.integer("/wall_pressure/rho_g_H_Pa") +
         " Pa, the impulse is their integral over T.</p>\n"
         "<p>The runs do not measure at the very same place: VOF gives the pressure on the wall; "
         "the "
         "probe of a particle run is a weighted mean over the fluid particles within two spacings "
         "of the point, whose centre lies half a spacing in front of the wall, as the first "
         "particles "
         "do. It smooths what is smaller than that, in space but not in time, and feels water "
         "before it is at the wall. Where water covers less than three quarters of these "
         "surroundings, the dry part counts with no pressure, as on the face of a sensor.</p>\n"
         "<p>SPH computes a slightly compressible liquid. Where it meets a wall at the speed v, "
         "the "
         "first pressure is that of a water hammer, ρ c v with its own speed of sound c, which is "
         "chosen for the cost and not that of water; it lasts as long as sound needs through the "
         "water at the wall, and what is left of it rings. VOF and MPS are incompressible: they "
         "have no such wave.</p>\n" +
         figure_html(page, "wall_pressure") +
         html_table("Wall pressure from the impact on",
                    {"Run", "Peak", "at T after the impact", "Impulse", "Noise", "Readable from T",
                     "Time step, median, s"},
                    rows) +
         notes;
}

}  // namespace surge::compare
