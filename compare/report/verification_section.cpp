#include <cmath>

#include "compare/report/sections.hpp"
#include "compare/study/levels.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

json or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json();
}

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
               {"momentum", or_null(result.momentum)},
               {"energy", or_null(result.energy)},
               {"volume", or_null(result.volume)}};
    if (coarser != nullptr)
      entry["order"] = or_null(
          observed_order(coarser->flow.spacing, coarser->error, result.flow.spacing, result.error));
    for (const FlowMeasure& measure : result.measures)
      entry["measures"][measure.name] = or_null(measure.value);
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

/// Column heading of a flow's further measure.
std::string heading(const std::string& name) {
  static const std::map<std::string, std::string> headings{
      {"noise", "Noise"},
      {"short_axis_at_end", "Short axis, end"},
      {"long_axis_at_end", "Long axis, end"},
      {"period", "Period − 1"},
      {"decay_per_s", "Decay, 1/s"},
      {"exact_decay_per_s", "exact"},
      {"amplitude", "Amplitude − 1"},
      {"spreading", "c"},
      {"exact_spreading", "exact"},
      {"corner_distance", "Corner − 1"},
      {"angular_momentum", "Angular momentum"},
      {"largest_speed_across", "Speed across"}};
  const auto found = headings.find(name);
  return found != headings.end() ? found->second : name;
}

std::string flow_table(const Page& page, const std::string& group) {
  const json& entry = page.values.at(key({"verification", group}));
  std::vector<std::string> header{"Method and preset", "Particles over L", "Error", "Order"};
  std::vector<std::string> names;
  for (const auto& [name, value] : entry["sequences"][0]["levels"][0]["measures"].items()) {
    names.push_back(name);
    header.push_back(heading(name));
  }
  for (const char* budget : {"Momentum", "Energy", "Volume"}) header.emplace_back(budget);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t s = 0; s < entry["sequences"].size(); ++s) {
    const std::string sequence = key({"verification", group, "sequences", std::to_string(s)});
    for (std::size_t i = 0; i < entry["sequences"][s]["levels"].size(); ++i) {
      const std::string at = sequence + "/levels/" + std::to_string(i);
      std::vector<std::string> row{
          page.values.text(sequence + "/label"), page.values.integer(at + "/particles_over_L"),
          page.values.number(at + "/error", 4), page.values.number(at + "/order", 1)};
      for (const std::string& name : names)
        row.push_back(page.values.number(at + "/measures/" + name, 4));
      for (const char* budget : {"momentum", "energy", "volume"})
        row.push_back(page.values.number(at + "/" + budget, 4));
      rows.push_back(std::move(row));
    }
  }
  return html_table(page.values.at(key({"verification", group, "error"})).get<std::string>(),
                    header, rows);
}

/// "Bar: ... MPS improved reaches it with ..., SPH delta-plus misses it with ..."
std::string bar_sentence(const Page& page, const std::string& group) {
  const json& entry = page.values.at(key({"verification", group}));
  if (entry["bar"].is_null()) return "";
  const std::string at = key({"verification", group});
  std::string said;
  for (std::size_t s = 0; s < entry["sequences"].size(); ++s) {
    const json& sequence = entry["sequences"][s];
    if (!sequence.contains("bar") || sequence["bar"].is_null()) continue;
    const std::string pointer = at + "/sequences/" + std::to_string(s);
    said += (said.empty() ? " " : ", ") + page.values.text(pointer + "/label") +
            (sequence["bar"]["reached"].get<bool>() ? " reaches" : " misses") + " it with " +
            page.values.number(pointer + "/bar/error", 4);
  }
  if (said.empty()) return "";
  return "<p>The recommended presets are to stay below " + page.values.number(at + "/bar", 2) +
         " at " + page.values.integer(at + "/bar_per_length") + " particles over L:" + said +
         ".</p>\n";
}

std::string missing_runs(const Page& page) {
  std::string html;
  for (const RunResult* run : page.study.runs_of(Role::verification)) {
    if (run->status == RunStatus::complete) continue;
    html +=
        "<li><code>" + escape(run->study.name) + "</code>: " + status_text(run->status) + "</li>";
  }
  return html.empty() ? "" : "<p>Runs that are not shown:</p><ul>" + html + "</ul>\n";
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
             {"bar", or_null(known.bar)},
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

std::string write_verification(const Page& page) {
  std::string html;
  for (const KnownFlow& known : known_flows()) {
    if (!page.values.has(key({"verification", known.group}))) continue;
    html += "<h3>" + escape(known.title) + "</h3>\n<p>" + escape(known.setup) + "</p>\n" +
            bar_sentence(page, known.group) + figure_html(page, "verification_" + known.group) +
            flow_table(page, known.group);
  }
  if (html.empty() && page.study.runs_of(Role::verification).empty()) return "";
  return "<p>Both methods with the presets as they are, from public case files. Order: observed "
         "between a row and the row above. Momentum: its error over mass and speed of the flow; "
         "energy: its error over that at the start (still water: over m g H); volume: its relative "
         "change, from the second moments of the drop, the mean height of the water, the area that "
         "the patch covers.</p>\n" +
         html + missing_runs(page);
}

}  // namespace surge::compare
