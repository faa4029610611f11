#include "compare/study/levels_ahead.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "compare/study/convergence.hpp"
#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;

/// Settings that say how fine and how long a run is, and not what it computes.
bool is_resolution(const std::string& setting) {
  constexpr std::array names{"resolution.", "time.end=",        "endTime=",      "cellsPerL=",
                             "foam.cells",  "output.interval=", "writeInterval="};
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return setting.starts_with(name); });
}

std::string told_computation(const StudyRun& run) {
  std::string key = run.program + '\n' + run.case_path.string();
  for (const std::string& setting : run.settings)
    if (!is_resolution(setting)) key += '\n' + setting;
  return key;
}

std::optional<double> number_at(const json& value, const json::json_pointer& place) {
  if (!value.is_object() || !value.contains(place) || !value.at(place).is_number())
    return std::nullopt;
  return value.at(place).get<double>();
}

/// Spacing or cell that the run will have, m; of the folder of an OpenFOAM case over its L.
std::optional<double> size_ahead(const StudyRun& run) {
  if (run.is_files()) return std::nullopt;
  if (run.program == "surge-particle")
    return number_at(run.resolved, json::json_pointer("/case/spacing"));
  if (run.made_from_case_file()) return number_at(run.resolved, json::json_pointer("/size/cell"));
  // The folder of a case knows its own L, which all of its levels share.
  const auto cells = number_at(run.resolved, json::json_pointer("/parameters/cellsPerL"));
  return cells && *cells > 0.0 ? std::optional(1.0 / *cells) : std::nullopt;
}

bool is_level(const StudyRun& run) {
  return run.role == Role::comparison || run.role == Role::convergence;
}

/// Sizes of all levels that the study has of a run, each once.
std::vector<Level> levels_ahead(const Study& study, const StudyRun& run) {
  std::vector<Level> levels;
  for (const StudyRun& other : study.runs) {
    const auto size = size_ahead(other);
    if (!size || !is_level(other) || !may_be_levels(other, run)) continue;
    const bool known = std::any_of(levels.begin(), levels.end(),
                                   [&](const Level& level) { return same_level(level.h, *size); });
    if (!known) levels.push_back({*size, 0.0});
  }
  return levels;
}

}  // namespace

bool may_be_levels(const StudyRun& a, const StudyRun& b) {
  if (!a.group.empty() && a.group == b.group) return true;
  return told_computation(a) == told_computation(b);
}

std::vector<std::string> verdicts_out_of_reach(const Study& study) {
  std::map<std::string, std::pair<std::string, std::size_t>> lacks;  // what there is: the runs
  for (const StudyRun& run : study.runs) {
    if (run.role != Role::comparison || !size_ahead(run)) continue;
    const std::vector<Level> levels = levels_ahead(study, run);
    if (systematic_levels(levels)) continue;
    const std::string found = levels.size() == 1   ? "one"
                              : levels.size() == 2 ? "two"
                                                   : "levels that are nearer to each other";
    auto& [names, count] = lacks[found];
    names += (names.empty() ? "" : ", ") + run.name;
    ++count;
  }
  std::vector<std::string> lines;
  for (const auto& [found, runs] : lacks)
    lines.push_back(runs.first + ": found " + found + ", expected three resolutions" +
                    (runs.second > 1 ? " of each" : "") + ", a factor of " +
                    number_text(smallest_ratio) +
                    " or more apart, to know the uncertainty; without it a difference gets no "
                    "verdict (role = \"convergence\" adds levels)");
  return lines;
}

}  // namespace surge::compare
