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

std::string shown(const Page& page, const std::string& pointer,
                  std::string (Values::*how)(const std::string&) const) {
  return page.values.has(pointer) ? (page.values.*how)(pointer) : "–";
}

std::string shown(const Page& page, const std::string& pointer, int decimals) {
  return page.values.has(pointer) ? page.values.number(pointer, decimals) : "–";
}

std::string status_cell(const Page& page, const RunResult& run) {
  const std::string pointer = key({"runs", run.study.name});
  std::string html = "<span class=\"status-" + status_text(run.status) + "\">" +
                     page.values.text(pointer + "/status") + "</span>";
  if (!run.note.empty()) html += ": " + page.values.text(pointer + "/note");
  return html;
}

/// The run's name; one that is not complete is marked wherever its numbers stand.
std::string name_cell(const Page& page, const RunResult& run) {
  const std::string pointer = key({"runs", run.study.name});
  std::string html = "<code>" + page.values.text(pointer + "/name") + "</code>";
  if (run.status == RunStatus::unfinished) {
    html +=
        " <span class=\"status-unfinished\">" + page.values.text(pointer + "/status") + "</span>";
  }
  return html;
}

std::string status_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& run : page.study.runs) {
    const std::string pointer = key({"runs", run.study.name});
    rows.push_back({"<code>" + page.values.text(pointer + "/name") + "</code>",
                    page.values.text(pointer + "/label"), status_cell(page, run)});
  }
  return "<div class=\"words\">" +
         html_table("Runs of the study", {"Run", "What", "Status"}, rows) + "</div>";
}

std::string accuracy_table(const Page& page) {
  const Values& values = page.values;
  const std::string against = values.at("/summary/against").get<std::string>();
  std::vector<std::vector<std::string>> rows;
  for (const auto& run : page.study.runs) {
    const std::string name = name_cell(page, run);
    if (run.measured == nullptr) {
      rows.push_back({name, status_cell(page, run), "–", "–", "–", "–", "–"});
      continue;
    }
    const std::string front = key({"front", run.study.name});
    const std::string window =
        values.number(front + "/window_T/0", 2) + " to " + values.number(front + "/window_T/1", 2);
    rows.push_back({name, window, values.number(front + "/rms_vs_" + against, 4),
                    values.number(front + "/max_vs_" + against, 4),
                    values.signed_number(front + "/bias_vs_" + against, 4),
                    shown(page, front + "/impact_time_s", 4), shown(page, front + "/impact_T", 3)});
  }
  return html_table("Leading edge Z/L against " + escape(page.study.reference().label()),
                    {"Run", "Window in T", "RMS", "Maximum", "Bias", "Impact, s", "Impact, T"},
                    rows);
}

std::string arrival_table(const Page& page) {
  std::vector<std::string> header{"Run"};
  const json& levels = page.values.at(key({"front", page.study.study.reference, "arrival_T"}));
  for (const auto& [level, value] : levels.items()) header.push_back("Z/L = " + level);
  std::vector<std::vector<std::string>> rows;
  for (const RunResult* run : page.study.measured()) {
    const std::string front = key({"front", run->study.name});
    std::vector<std::string> row{name_cell(page, *run)};
    for (const auto& [level, value] : levels.items()) {
      std::string cell = page.values.number(front + "/arrival_T/" + level, 3);
      const std::string difference = front + "/arrival_T_difference/" + level;
      if (run != &page.study.reference() && page.values.has(difference)) {
        cell += " (" + page.values.signed_number(difference, 3) + ")";
      }
      row.push_back(cell);
    }
    rows.push_back(row);
  }
  return html_table("Time of arrival T; in brackets: after the reference", header, rows);
}

std::string cost_table(const Page& page) {
  std::vector<std::vector<std::string>> rows;
  for (const RunResult* run : page.study.measured()) {
    const std::string timing = key({"timing", run->study.name});
    const bool particles = page.values.has(timing + "/particles");
    rows.push_back({name_cell(page, *run),
                    shown(page, timing + (particles ? "/particles" : "/cells"), 0),
                    shown(page, timing + "/steps", 0), shown(page, timing + "/threads", 0),
                    shown(page, timing + "/wall_s", &Values::magnitude),
                    shown(page, timing + "/wall_s_per_simulated_s", &Values::magnitude),
                    shown(page, timing + "/body_steps_per_s", &Values::magnitude)});
  }
  return html_table("Cost, output included",
                    {"Run", "Fluid particles or cells", "Steps", "Threads", "Wall, s",
                     "Wall per simulated s", "Particle- or cell-steps per s"},
                    rows);
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

std::string write_runs(const Page& page) {
  return status_table(page) + accuracy_table(page) + arrival_table(page) + cost_table(page) +
         "<p>RMS, maximum and bias are of the difference run minus reference inside the window "
         "that "
         "both share: it ends where either front comes within " +
         page.values.number("/definition/wall_distance_L", 2) +
         " L of the far wall. The leading edge is the farthest water connected to the main body in "
         "the lowest " +
         page.values.magnitude("/definition/strip_height_m") +
         " m above the floor. A dash: not reached, or not stated by the run.</p>\n";
}

}  // namespace surge::compare
