#include "compare/report/study_result.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>

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

std::string note_of(const MeasuredRun& measured, bool finished) {
  const std::string last = short_number(measured.history.back().time.value()) + " s";
  if (measured.history.size() < measured.run.frames->times().size()) {
    return "no leading edge after " + last;
  }
  return finished ? "" : "ends at " + last;
}

bool is_finished(const Run& run) {
  return run.manifest.is_object() && run.manifest.value("finished", false);
}

/// Throws Error where the two runs computed different cases or share no time.
void require_comparable(const MeasuredRun& run, const MeasuredRun& reference,
                        const WallRule& wall) {
  require_same_physics(
      compare_physics(run.run.physics, run.run.name, reference.run.physics, reference.run.name),
      {});
  static_cast<void>(common_window(run.front, reference.front, wall));
}

WallRule wall_of(const Physics& physics) {
  WallRule rule;
  if (const auto wall = physics.far_wall()) rule.far_wall = physics.scales().dimensionless(*wall);
  return rule;
}

MeasuredRun measure_reference(const Study& study, const fs::path& folder,
                              const FrontOptions& options) {
  const std::string what = "reference run " + study.reference + ": ";
  if (!fs::exists(folder)) {
    throw Error(what + folder.string() + " does not exist, expected the run's folder");
  }
  try {
    return measure(open_run(folder), options);
  } catch (const Error& error) {
    throw Error(what + error.what());
  }
}

/// Sets the run's status; gives the measured run where it may stand beside the reference.
std::optional<MeasuredRun> collect_run(RunResult& result, const fs::path& folder,
                                       const MeasuredRun& reference, const FrontOptions& options) {
  if (!fs::exists(folder)) {
    result.note = folder.string() + " does not exist";
    return std::nullopt;
  }
  try {
    MeasuredRun measured = measure(open_run(folder), options);
    require_comparable(measured, reference, wall_of(reference.run.physics));
    return measured;
  } catch (const Error& error) {
    result.status = RunStatus::unusable;
    result.note = error.what();
    return std::nullopt;
  }
}

TimedRun timed_run(const StudyRun& run, const fs::path& folder) {
  std::ifstream in(folder / "manifest.json");
  nlohmann::json manifest = nlohmann::json::parse(in, nullptr, false);
  const bool good = manifest.is_object() && manifest.value("finished", false) &&
                    manifest.contains("case") && manifest.contains("wall_s");
  return {run, good ? std::move(manifest) : nlohmann::json()};
}

}  // namespace

std::string status_text(RunStatus status) {
  switch (status) {
    case RunStatus::complete:
      return "complete";
    case RunStatus::unfinished:
      return "unfinished";
    case RunStatus::unusable:
      return "unusable";
    case RunStatus::missing:
      return "missing";
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
  return wall_of(reference_run().run.physics);
}

std::optional<Seconds> StudyResult::impact_time() const {
  const MeasuredRun& reference = reference_run();
  const auto far = reference.run.physics.far_wall();
  const auto hit = far ? impact(reference.history, *far, reference.run.spacing) : std::nullopt;
  return hit ? std::optional(hit->time) : std::nullopt;
}

const PatternHistory& StudyResult::pattern(const RunResult& run) const {
  const auto known = patterns_.find(run.study.name);
  if (known != patterns_.end()) return known->second;
  return patterns_[run.study.name] = measure_pattern(run.measured->run, reference_run().run);
}

StudyResult collect(const Study& study, const fs::path& runs, const fs::path& series_folder) {
  StudyResult result;
  result.study = study;
  for (const auto& name : study.published) {
    result.published.push_back(read_series(series_folder / (name + ".csv")));
  }
  const FrontOptions options = result.front_options();
  // Results point into this vector, which therefore must not grow beyond what it holds now.
  result.measured_runs.reserve(study.runs.size());
  const MeasuredRun& reference =
      result.measured_runs.emplace_back(measure_reference(study, runs / study.reference, options));
  for (const auto& run : study.runs) {
    if (run.timing) {
      result.timed.push_back(timed_run(run, runs / run.name));
      continue;
    }
    RunResult entry{run, RunStatus::missing, "", nullptr};
    if (run.name == study.reference) {
      entry.measured = &reference;
    } else if (auto measured = collect_run(entry, runs / run.name, reference, options)) {
      entry.measured = &result.measured_runs.emplace_back(std::move(*measured));
    }
    if (entry.measured != nullptr) {
      const bool finished = is_finished(entry.measured->run);
      entry.status = finished ? RunStatus::complete : RunStatus::unfinished;
      entry.note = note_of(*entry.measured, finished);
    }
    result.runs.push_back(std::move(entry));
  }
  return result;
}

}  // namespace surge::compare
