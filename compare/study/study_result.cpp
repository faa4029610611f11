#include "compare/study/study_result.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "compare/measure/registry.hpp"
#include "compare/read/recorded.hpp"
#include "compare/study/identity.hpp"
#include "compare/study/kept_frames.hpp"
#include "compare/study/measure_run.hpp"
#include "compare/study/run_fault.hpp"
#include "particle/support/error.hpp"
#include "particle/support/table.hpp"

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
  const bool front = !measured.history.empty();
  const Seconds end = front ? measured.history.back().time : measured.run.frames->times().back();
  const std::string last = short_number(end.value()) + " s";
  if (!front) return finished ? "" : "ends at " + last;
  if (measured.history.size() < measured.run.frames->times().size()) {
    return "no leading edge after " + last;
  }
  return finished ? "" : "ends at " + last;
}

bool is_finished(const Run& run) {
  return run.manifest.is_object() && run.manifest.value("finished", false);
}

/// Throws Error where the two runs computed different cases or share no time. The wall condition is
/// one of the choices whose effect a study of sensitivity shows.
void require_comparable(const MeasuredRun& run, const MeasuredRun& reference, const WallRule& wall,
                        const StudyRun& asked) {
  std::set<std::string> allowed = asked.allowed_differences;
  if (asked.role == Role::sensitivity) allowed.insert("wall");
  require_same_physics(
      compare_physics(run.run.physics, run.run.name, reference.run.physics, reference.run.name),
      allowed);
  if (!reference.history.empty())
    static_cast<void>(common_window(run.front, reference.front, wall));
}

WallRule wall_of(const Physics& physics) {
  WallRule rule;
  if (const auto wall = physics.far_wall()) rule.far_wall = physics.scales().dimensionless(*wall);
  return rule;
}

Run open_folder(const StudyRun& run, const fs::path& folder) {
  return guarded(run.name, folder, [&] {
    Run source = open_run(folder, run.source);
    source.name = run.name;
    guard_frames(source, run.name);
    return source;
  });
}

/// Which front it has, and which observables, follows from its case: both go to the result.
MeasuredRun measure_reference(StudyResult& result, const fs::path& runs, const Faults& known) {
  const Study& study = result.study;
  const std::string what = "reference run " + study.reference + ": ";
  const auto is_reference = [&](const StudyRun& run) {
    return run.name == study.reference && run.role == Role::comparison;
  };
  const StudyRun& run = *std::find_if(study.runs.begin(), study.runs.end(), is_reference);
  const fs::path folder = run.folder(runs);
  if (!run.is_files() && !fs::exists(folder))
    throw Error(what + folder.string() + " does not exist, expected the run's folder");
  if (const auto fault = known.find(run.name); fault != known.end())
    throw Error(what + fault->second);
  try {
    if (fs::exists(folder / "manifest.json")) {
      const auto other = guarded(run.name, folder, [&] {
        return other_run(run, folder, read_manifest(folder / "manifest.json"));
      });
      if (other) throw Error(folder.string() + ": " + *other);
    }
    return guarded(run.name, folder, [&] {
      Run source = open_folder(run, folder);
      result.has_front =
          asks_for_front(study) && (!study.observables.empty() || source.physics.has_surge());
      result.observables = study_observables(study, source);
      RunResult asked;
      asked.study = run;
      return measure_for_study(std::move(source), result.request(asked, nullptr));
    });
  } catch (const Error& error) {
    throw Error(what + error.what());
  }
}

/// Sets the run's status; gives the measured run where it may stand beside the reference.
std::optional<MeasuredRun> measure_run(RunResult& result, const StudyResult& study,
                                       const StudyFrames& frames) {
  const MeasuredRun& reference = study.measured_runs.front();
  const bool missing = result.status == RunStatus::missing && !result.study.is_files();
  if (missing || !result.readable) return std::nullopt;
  try {
    return guarded(result.study.name, result.folder, [&] {
      Run run = open_folder(result.study, result.folder);
      // Those that are shown are looked at again.
      if (result.study.role == Role::comparison) keep_frames(run, frames.budget);
      MeasuredRun measured =
          measure_for_study(std::move(run), study.request(result, frames.reference.get()));
      require_comparable(measured, reference, wall_of(reference.run.physics), result.study);
      return measured;
    });
  } catch (const Error& error) {
    result.status = RunStatus::unusable;
    result.note = error.what();
    return std::nullopt;
  }
}

/// What the files say without a look at the flow.
RunResult find_run(const StudyRun& run, const fs::path& folder, const Faults& known) {
  RunResult result;
  result.study = run;
  result.folder = folder;
  const auto unusable = [&](const std::string& why) {
    result.status = RunStatus::unusable;
    result.note = why;
    result.readable = false;
    return result;
  };
  if (const auto fault = known.find(run.name); fault != known.end()) return unusable(fault->second);
  const fs::path file = folder / "manifest.json";
  if (run.is_files() && !fs::exists(file)) return result;  // opening them says what is there
  if (!fs::exists(folder)) {
    result.note = folder.string() + " does not exist";
    return result;
  }
  try {
    result.manifest = guarded(run.name, file, [&] { return read_manifest(file); });
  } catch (const Error& error) {
    unusable(error.what());
    result.readable = !fs::exists(file);  // a foam run that was killed has none, but its fields
    return result;
  }
  if (const auto other = other_run(run, folder, result.manifest)) return unusable(*other);
  const bool finished = result.manifest.value("finished", false);
  result.status = finished ? RunStatus::complete : RunStatus::unfinished;
  if (!finished) result.note = result.manifest.value("stopped", "not finished");
  return result;
}

void take_front(RunResult& result, const MeasuredRun& measured) {
  result.measured = &measured;
  // Nothing says whether the files of another program are all of them.
  const bool finished =
      is_finished(measured.run) || (result.study.is_files() && measured.run.manifest.is_null());
  result.status = finished ? RunStatus::complete : RunStatus::unfinished;
  result.note = note_of(measured, finished);
}

bool has_front(Role role) {
  return role == Role::comparison || role == Role::sensitivity || role == Role::convergence;
}

/// The same run in another role, whose front is known already.
const RunResult* twin(const StudyResult& study, const RunResult& result) {
  for (const auto* list : {&study.runs, &study.others}) {
    for (const RunResult& other : *list)
      if (other.study.name == result.study.name && has_front(other.study.role)) return &other;
  }
  return nullptr;
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
  if (!measured) return std::nullopt;
  if (measured->history.empty()) return measured->run.frames->times().back();
  return measured->history.back().time;
}

const RunResult& StudyResult::reference() const {
  return *std::find_if(runs.begin(), runs.end(),
                       [this](const RunResult& r) { return r.study.name == study.reference; });
}

std::vector<const RunResult*> StudyResult::runs_of(Role role) const {
  std::vector<const RunResult*> result;
  for (const auto& run : role == Role::comparison ? runs : others) {
    if (run.study.role == role) result.push_back(&run);
  }
  return result;
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

MeasureRequest StudyResult::request(const RunResult& run, WaterOfRun* reference_of_pattern) const {
  const nlohmann::json::json_pointer distance("/case/method/parameters/collision_distance");
  const bool collides = !run.manifest.contains(distance) || run.manifest.at(distance) != 0.0;
  const Role role = run.study.role;
  const bool pattern =
      role == Role::comparison || (judges_paper() && (role == Role::convergence || !collides));
  return {has_front ? std::optional(front_options()) : std::nullopt, pattern, reference_of_pattern,
          &observables};
}

const ReferenceSeries& StudyResult::series(const std::string& name) const {
  const auto found = std::find_if(references.begin(), references.end(),
                                  [&](const ReferenceSeries& one) { return one.name == name; });
  if (found == references.end())
    throw Error("reference: found no series " + name + ", expected one that the study names");
  return *found;
}

namespace {

void measure_known_flow(StudyResult& study, RunResult& entry) {
  if (entry.study.role != Role::verification || entry.status != RunStatus::complete) return;
  try {
    study.flows.emplace(std::pair{entry.study.group, entry.study.name},
                        guarded(entry.study.name, entry.folder, [&] {
                          return measure_flow(entry.study.group, entry.folder, entry.manifest);
                        }));
  } catch (const Error& error) {
    entry.status = RunStatus::unusable;
    entry.note = error.what();
  }
}

}  // namespace

namespace {

void read_references(StudyResult& result, const fs::path& folder) {
  for (const StudyObservable& observable : result.study.observables) {
    for (const std::string& name : observable.references) {
      const bool known = std::any_of(result.references.begin(), result.references.end(),
                                     [&](const auto& one) { return one.name == name; });
      if (!known)
        result.references.push_back(
            read_reference(series_file(result.study, name, folder), observable_names()));
    }
  }
}

}  // namespace

StudyResult collect(const Study& study, const fs::path& runs, const fs::path& series_folder,
                    const Faults& known) {
  StudyResult result;
  result.study = study;
  // Results point into these vectors, which therefore must not grow beyond what they hold now.
  result.measured_runs.reserve(study.runs.size());
  result.measured_others.reserve(study.runs.size());
  StudyFrames frames;
  if (result.has_reference()) {
    result.measured_runs.push_back(measure_reference(result, runs, known));
    frames.reference = std::make_unique<WaterOfRun>(result.measured_runs.front().run);
  }
  read_references(result, series_folder);
  for (const auto& name : study.published) {
    PublishedSeries series = read_series(series_file(study, name, series_folder));
    const bool same = result.measured_runs.empty() ||
                      !other_case(series, result.measured_runs.front().run.physics);
    (same ? result.published : result.published_elsewhere).push_back(std::move(series));
  }
  for (const auto& run : study.runs) {
    RunResult entry = find_run(run, run.folder(runs), known);
    const bool story = run.role == Role::comparison;
    auto& fronts = story ? result.measured_runs : result.measured_others;
    if (has_front(run.role)) {
      if (story && run.name == study.reference) {
        take_front(entry, result.measured_runs.front());
      } else if (const RunResult* same = twin(result, entry); same && same->measured && !story) {
        take_front(entry, *same->measured);
      } else if (auto measured = measure_run(entry, result, frames)) {
        take_front(entry, fronts.emplace_back(std::move(*measured)));
      }
    }
    measure_known_flow(result, entry);
    (story ? result.runs : result.others).push_back(std::move(entry));
  }
  return result;
}

}  // namespace surge::compare
