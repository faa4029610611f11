#include "compare/read/method_sheet.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// How a parameter of a run stands to what the publication says of it.
std::string agreement(const StatedSetting* setting, const json& value, const json& stated) {
  if (setting == nullptr) return "not in the paper";
  if (!is_any_on(setting->acts_with, stated)) return "does not act";
  if (setting->value.is_null()) return "left open";
  return setting->value == value ? "as stated" : "departs";
}

/// {parameter: {value, agreement, paper, place}} of one run.
json deviations_of(const Run& run, const Statements& statements) {
  const json& own = run.manifest.at("case");
  const json& parameters = own.at("method").at("parameters");
  json out = json::object();
  for (const auto& [parameter, value] : parameters.items()) {
    const StatedSetting* setting = statements.setting(run.method, parameter);
    const std::string how = agreement(setting, value, own);
    const bool stated = how == "as stated" || how == "departs";
    out[parameter] = {{"value", value},
                      {"agreement", how},
                      {"paper", stated ? setting->value : json(nullptr)},
                      {"place", setting != nullptr ? setting->place : "an option of this program"}};
  }
  return out;
}

}  // namespace

void measure_deviations(const StudyResult& study, json& metrics) {
  const Statements& statements = study.study.statements;
  metrics["paper"] = {{"citation", statements.citation}, {"comparator", statements.comparator}};
  metrics["deviations"] = json::object();
  metrics["deviation_counts"] = json::object();
  const json::json_pointer path("/case/method/parameters");
  for (const RunResult* run : study.measured()) {
    const json& manifest = run->measured->run.manifest;
    if (run->measured->run.is_mesh() || !manifest.is_object() || !manifest.contains(path)) continue;
    const json all = deviations_of(run->measured->run, statements);
    int departs = 0, open = 0;
    for (const auto& entry : all) {
      const std::string how = entry["agreement"];
      if (how == "left open") ++open;
      if (how == "departs" || how == "not in the paper") ++departs;
    }
    metrics["deviations"][run->study.name] = all;
    metrics["deviation_counts"][run->study.name] = {{"departs", departs}, {"open", open}};
  }
}

void measure_errata(const StudyResult& study, json& metrics) {
  metrics["errata"] = json::array();
  for (const Erratum& e : study.study.statements.errata) {
    metrics["errata"].push_back({{"place", e.place},
                                 {"printed", e.printed},
                                 {"correct", e.correct},
                                 {"derivation", e.derivation},
                                 {"test_file", e.test_file},
                                 {"test", e.test}});
  }
}

}  // namespace surge::compare
