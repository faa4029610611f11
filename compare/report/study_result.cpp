#include "compare/report/study_result.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "compare/figures/table.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Up to four decimals, without trailing zeros.
std::string short_number(double value) {
  std::string text = fixed_text(value, 4);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

RunResult collect_run(const StudyRun& study, const fs::path& folder, const FrontOptions& options) {
  RunResult result{study, RunStatus::missing, folder.string() + " does not exist", std::nullopt};
  if (!fs::exists(folder)) return result;
  try {
    result.measured = measure(open_run(folder), options);
  } catch (const Error& error) {
    result.status = RunStatus::unreadable;
    result.note = error.what();
    return result;
  }
  const auto& manifest = result.measured->run.manifest;
  const bool finished = manifest.is_object() && manifest.value("finished", false);
  result.status = finished ? RunStatus::complete : RunStatus::unfinished;
  result.note = finished ? "" : "ends at " + short_number(result.last_time()->value()) + " s";
  return result;
}

}  // namespace

std::string status_text(RunStatus status) {
  switch (status) {
    case RunStatus::complete: return "complete";
    case RunStatus::unfinished: return "unfinished";
    case RunStatus::unreadable: return "unreadable";
    case RunStatus::missing: return "missing";
  }
  return "unknown";
}

std::string RunResult::label() const {
  if (!measured) return study.name;
  const Run& run = measured->run;
  std::string text = upper(run.method);
  if (run.cells_per_width) {
    if (!run.preset.empty()) text += ' ' + run.preset;
    return text + ", " + short_number(*run.cells_per_width) + " cells per L";
  }
  if (!run.preset.empty()) text += ' ' + run.preset;
  return text + ", l0 = " + short_number(1e3 * run.spacing.value()) + " mm";
}

std::optional<Seconds> RunResult::last_time() const {
  if (!measured || measured->history.empty()) return std::nullopt;
  return measured->history.back().time;
}

const RunResult& StudyResult::reference() const {
  return *std::find_if(runs.begin(), runs.end(),
                       [this](const RunResult& r) { return r.study.name == study.reference; });
}

std::vector<const RunResult*> StudyResult::measured() const {
  std::vector<const RunResult*> result;
  for (const auto& run : runs) {
    if (run.measured) result.push_back(&run);
  }
  return result;
}

WallRule StudyResult::wall() const {
  WallRule rule;
  const Physics& physics = reference_run().run.physics;
  if (const auto wall = physics.far_wall()) rule.far_wall = physics.scales().dimensionless(*wall);
  return rule;
}

StudyResult collect(const Study& study, const fs::path& runs, const fs::path& series_folder) {
  StudyResult result{study, {}, {}};
  for (const auto& run : study.runs) {
    result.runs.push_back(collect_run(run, runs / run.name, result.front_options()));
  }
  const RunResult& reference = result.reference();
  if (!reference.measured) {
    throw Error("reference run " + study.reference + ": " + status_text(reference.status) + " (" +
                reference.note + "), expected a run that can be measured");
  }
  for (const auto& name : study.published) {
    result.published.push_back(read_series(series_folder / (name + ".csv")));
  }
  return result;
}

}  // namespace surge::compare
