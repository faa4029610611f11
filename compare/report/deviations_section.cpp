#include "compare/report/paper_settings.hpp"
#include "compare/report/sections.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

/// {parameter: {value, agreement, paper, place}} of one run.
json deviations_of(const Run& run, const json& parameters) {
  json out = json::object();
  for (const auto& [parameter, value] : parameters.items()) {
    const PaperSetting* setting = find_paper_setting(run.method, parameter);
    const Agreement agreement = compare_with_paper(setting, value);
    const bool stated = agreement == Agreement::as_stated || agreement == Agreement::departs;
    out[parameter] = {{"value", value},
                      {"agreement", agreement_text(agreement)},
                      {"paper", stated ? json::parse(setting->value) : json(nullptr)},
                      {"place", setting != nullptr ? setting->place : "an option of this program"}};
  }
  return out;
}

std::string run_table(const Page& page, const RunResult& run) {
  const std::string base = key({"deviations", run.study.name});
  std::vector<std::vector<std::string>> departures;
  std::vector<std::vector<std::string>> others;
  for (const auto& [parameter, entry] : page.values.at(base).items()) {
    const std::string pointer = base + key({parameter});
    const std::string agreement = entry["agreement"];
    const bool departs = agreement == agreement_text(Agreement::departs) ||
                         agreement == agreement_text(Agreement::unknown);
    std::string verdict = page.values.text(pointer + "/agreement");
    if (departs) verdict = "<strong>" + verdict + "</strong>";
    (departs ? departures : others)
        .push_back({"<code>" + escape(parameter) + "</code>", page.values.text(pointer + "/value"),
                    page.values.text(pointer + "/paper"), verdict,
                    page.values.text(pointer + "/place")});
  }
  const std::size_t count = departures.size();
  departures.insert(departures.end(), others.begin(), others.end());
  return std::string("<details") + (count > 0 ? " open=\"open\"" : "") + ">\n<summary><code>" +
         page.values.text(key({"runs", run.study.name, "name"})) +
         "</code>: " + page.values.integer(key({"deviation_counts", run.study.name, "departs"})) +
         " departing from the paper, " +
         page.values.integer(key({"deviation_counts", run.study.name, "open"})) +
         " left open by it</summary>\n<div class=\"words\">" +
         html_table("Parameters of " + escape(run.label()),
                    {"Parameter", "Here", "Paper", "", "Where"}, departures) +
         "</div>\n</details>\n";
}

}  // namespace

void measure_deviations(const StudyResult& study, json& metrics) {
  metrics["deviations"] = json::object();
  metrics["deviation_counts"] = json::object();
  const json::json_pointer path("/case/method/parameters");
  for (const RunResult* run : study.measured()) {
    const json& manifest = run->measured->run.manifest;
    if (run->measured->run.is_mesh() || !manifest.is_object() || !manifest.contains(path)) continue;
    const json all = deviations_of(run->measured->run, manifest.at(path));
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

std::string write_deviations(const Page& page) {
  std::string html =
      "<p>Resolved parameters as each run’s manifest states them, against what the paper says. "
      "<em>Left open</em>: the paper gives no value, so ours is a choice. The reference is "
      "computed "
      "with interFoam instead of the paper’s FLUENT, whose mesh and settings it does not "
      "give.</p>\n";
  for (const RunResult* run : page.study.measured()) {
    if (page.values.has(key({"deviations", run->study.name}))) html += run_table(page, *run);
  }
  return html;
}

}  // namespace surge::compare
