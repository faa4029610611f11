#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// Steps of all particles (cells) per second of the whole run, output included.
json steps_per_second(const json& timing) {
  const auto number = [&](const char* name) {
    return timing.contains(name) && timing[name].is_number() ? timing[name].get<double>() : 0.0;
  };
  const double bodies = number("particles") > 0.0 ? number("particles") : number("cells");
  if (bodies <= 0.0 || number("steps") <= 0.0 || number("wall_s") <= 0.0) return nullptr;
  return bodies * number("steps") / number("wall_s");
}

json wall_per_simulated_second(const json& timing, const RunResult& run) {
  const auto last = run.last_time();
  const json wall = timing.value("wall_s", json());
  // A run that was killed may have left a manifest from its start, with no time in it.
  if (!last || last->value() <= 0.0 || !wall.is_number() || wall.get<double>() <= 0.0) {
    return nullptr;
  }
  return wall.get<double>() / last->value();
}

}  // namespace

void measure_runs(const StudyResult& study, json& metrics) {
  json& runs = metrics["runs"] = json::object();
  for (const auto& run : study.runs) {
    const auto last = run.last_time();
    runs[run.study.name] = {{"name", run.study.name},
                            {"label", run.label()},
                            {"status", status_text(run.status)},
                            {"note", run.note},
                            {"last_front_s", last ? json(last->value()) : json(nullptr)},
                            {"program", run.study.program},
                            {"case", run.study.case_path.string()},
                            {"settings", run.study.settings}};
    if (run.measured == nullptr) continue;
    json& timing = metrics["timing"][run.study.name];
    timing["body_steps_per_s"] = steps_per_second(timing);
    timing["wall_s_per_simulated_s"] = wall_per_simulated_second(timing, run);
  }
}

}  // namespace surge::compare
