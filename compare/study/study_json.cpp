#include "compare/study/study_json.hpp"

#include <algorithm>

#include "compare/study/levels_ahead.hpp"

namespace surge::compare {

using nlohmann::json;

namespace {

json run_json(const StudyRun& run) {
  json read = json::object();
  for (const auto& [key, value] : run.read) read[key] = value;
  return {{"name", run.name},
          {"program", run.program},
          {"case", run.case_file.string()},
          {"settings", run.settings},
          {"threads", run.threads},
          {"timed", run.timed},
          {"may_break", run.may_break},
          {"roles", json::array()},
          {"map", run.map ? json(run.map->string()) : json(nullptr)},
          {"read", read},
          {"resolved", run.resolved}};
}

}  // namespace

json to_json(const Study& study, const std::string& only) {
  json out{{"title", study.title},
           {"files", json::array()},
           {"reference", study.reference},
           {"strip_height", study.strip_height.value()},
           {"snapshot_times", json::array()},
           {"claims", study.claims},
           {"published", json::array()},
           {"notices", json::array()},
           {"runs", json::array()}};
  if (only.empty()) out["notices"] = verdicts_out_of_reach(study);
  for (const auto& file : study.files) out["files"].push_back(file.string());
  for (const Seconds time : study.snapshot_times) out["snapshot_times"].push_back(time.value());
  for (const StudyObservable& observable : study.observables)
    out["observables"].push_back({{"name", observable.name},
                                  {"request", observable.request()},
                                  {"references", observable.references}});
  for (const std::string& name : named_series(study))
    out["published"].push_back({{"name", name}, {"file", series_file(study, name).string()}});
  for (const StudyRun& run : study.runs) {
    if (!only.empty() && run.name != only) continue;
    auto known = std::find_if(out["runs"].begin(), out["runs"].end(),
                              [&](const json& other) { return other["name"] == run.name; });
    if (known == out["runs"].end()) {
      out["runs"].push_back(run_json(run));
      known = out["runs"].end() - 1;
    }
    json& entry = *known;
    entry["roles"].push_back({{"role", role_text(run.role)}, {"group", run.group}});
    entry["timed"] = entry["timed"].get<bool>() || run.timed;
    entry["may_break"] = entry["may_break"].get<bool>() || run.may_break;
  }
  return out;
}

}  // namespace surge::compare
