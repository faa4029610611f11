#include "compare/report/paper_settings.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// {parameter: {value, agreement, paper, place}} of one run.
json deviations_of(const Run& run) {
  const json& own = run.manifest.at("case");
  const json& parameters = own.at("method").at("parameters");
  json out = json::object();
  for (const auto& [parameter, value] : parameters.items()) {
    const PaperSetting* setting = find_paper_setting(run.method, parameter);
    const Agreement agreement = compare_with_paper(setting, value, own);
    const bool stated = agreement == Agreement::as_stated || agreement == Agreement::departs;
    out[parameter] = {{"value", value},
                      {"agreement", agreement_text(agreement)},
                      {"paper", stated ? json::parse(setting->value) : json(nullptr)},
                      {"place", setting != nullptr ? setting->place : "an option of this program"}};
  }
  return out;
}

}  // namespace

void measure_deviations(const StudyResult& study, json& metrics) {
  metrics["deviations"] = json::object();
  metrics["deviation_counts"] = json::object();
  const json::json_pointer path("/case/method/parameters");
  for (const RunResult* run : study.measured()) {
    const json& manifest = run->measured->run.manifest;
    if (run->measured->run.is_mesh() || !manifest.is_object() || !manifest.contains(path)) continue;
    const json all = deviations_of(run->measured->run);
    int departs = 0, open = 0;
    for (const auto& entry : all) {
      const std::string agreement = entry["agreement"];
      if (agreement == agreement_text(Agreement::open)) ++open;
      if (agreement == agreement_text(Agreement::departs) ||
          agreement == agreement_text(Agreement::unknown)) {
        ++departs;
      }
    }
    metrics["deviations"][run->study.name] = all;
    metrics["deviation_counts"][run->study.name] = {{"departs", departs}, {"open", open}};
  }
}

}  // namespace surge::compare
