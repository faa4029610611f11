#include "compare/study/sensitivity.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "particle/support/error.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

constexpr const char* base_group = "base";

struct Setting {
  std::string key, value;
};

Setting split(const std::string& text) {
  const auto equals = text.find('=');
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// "mps", "sph" or "vof", also of a run that was never made.
std::string method_of(const StudyRun& run) {
  if (run.program != "surge-particle") return "vof";
  for (const std::string& text : run.settings) {
    const Setting setting = split(text);
    if (setting.key == "method.name") return setting.value;
  }
  return "particles";
}

/// Values without repetition, as of a Courant number that has two entries.
std::string joined(const std::vector<std::string>& values) {
  std::string text;
  std::set<std::string> known;
  for (const std::string& value : values) {
    if (known.insert(value).second) text += (text.empty() ? "" : ", ") + value;
  }
  return text;
}

/// What a run varies, and what the base has there.
void add_choice(const StudyRun& run, const StudyRun& base, json& out) {
  std::vector<std::string> keys, values, base_values;
  for (const std::string& text : run.settings) {
    if (std::find(base.settings.begin(), base.settings.end(), text) != base.settings.end())
      continue;
    const Setting own = split(text);
    keys.push_back(own.key);
    values.push_back(own.value);
    for (const std::string& other : base.settings) {
      if (split(other).key == own.key) base_values.push_back(split(other).value);
    }
  }
  out["choice"] = run.group;
  out["keys"] = keys;
  out["value"] = joined(values);
  out["base_value"] = base_values.empty() ? json() : json(joined(base_values));
}

json count(const RunResult& run, const char* name) {
  return run.manifest.is_object() && run.manifest.contains(name) ? run.manifest[name] : json();
}

/// CPU seconds per simulated second.
json cost(const RunResult& run) {
  const json cpu = count(run, "cpu_s"), simulated = count(run, "simulated_s");
  if (!cpu.is_number() || !simulated.is_number() || simulated.get<double>() <= 0.0) return nullptr;
  return cpu.get<double>() / simulated.get<double>();
}

json ratio(const json& a, const json& b) {
  if (!a.is_number() || !b.is_number() || b.get<double>() <= 0.0) return nullptr;
  return a.get<double>() / b.get<double>();
}

void add_front(const StudyResult& study, const RunResult& run, const RunResult& base, json& out) {
  for (const char* name :
       {"rms", "max", "bias", "window_end_T", "rms_vs_base", "bias_vs_base", "impact_time_s"})
    out[name] = nullptr;
  if (run.measured == nullptr) return;
  const FrontDifference d =
      difference(run.measured->front, study.reference_run().front, study.wall());
  out["rms"] = d.rms;
  out["max"] = d.maximum;
  out["bias"] = d.bias;
  out["window_end_T"] = d.window.end.value();
  if (base.measured != nullptr) {
    const FrontDifference own = difference(run.measured->front, base.measured->front, study.wall());
    out["rms_vs_base"] = own.rms;
    out["bias_vs_base"] = own.bias;
  }
  const Run& source = run.measured->run;
  const auto far = source.physics.far_wall();
  const auto hit = far ? impact(run.measured->history, *far, source.spacing) : std::nullopt;
  if (hit) out["impact_time_s"] = hit->time.value();
}

json entry(const StudyResult& study, const RunResult& run, const RunResult& base) {
  json out{{"run", run.study.name}, {"status", status_text(run.status)}, {"note", run.note}};
  add_choice(run.study, base.study, out);
  add_front(study, run, base, out);
  out["steps"] = count(run, "steps");
  out["cpu_s"] = count(run, "cpu_s");
  out["simulated_s"] = count(run, "simulated_s");
  out["cost_ratio"] = ratio(cost(run), cost(base));
  return out;
}

}  // namespace

void measure_sensitivity(const StudyResult& study, json& metrics) {
  json& all = metrics["sensitivity"] = json::object();
  const auto runs = study.runs_of(Role::sensitivity);
  for (const RunResult* base : runs) {
    if (base->study.group != base_group) continue;
    json& method = all[method_of(base->study)];
    method["base"] = entry(study, *base, *base);
    method["runs"] = json::array();
    for (const RunResult* run : runs) {
      if (run->study.group != base_group && method_of(run->study) == method_of(base->study))
        method["runs"].push_back(entry(study, *run, *base));
    }
  }
}

}  // namespace surge::compare
