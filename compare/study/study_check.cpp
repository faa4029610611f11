#include "compare/study/study_check.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <map>
#include <thread>

#include "compare/measure/registry.hpp"
#include "compare/read/readers.hpp"
#include "compare/reference/reference_series.hpp"
#include "compare/reference/series.hpp"
#include "compare/study/identity.hpp"
#include "compare/study/run_fault.hpp"
#include "particle/case/case_checks.hpp"
#include "particle/case/case_file.hpp"
#include "particle/case/case_json.hpp"
#include "particle/support/process.hpp"
#include "particle/support/spelling.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string in_marks(const std::string& text) {
  std::string out = "\"";
  return out.append(text).append("\"");
}

[[noreturn]] void refuse(const StudyRun& run, const std::string& key, const std::string& found,
                         const std::string& expected) {
  throw Error(run.place + "." + key + ": found " + found + ", expected " + expected);
}

/// What a program says, in one line and without its name.
std::string one_line(std::string said, const std::string& program) {
  if (said.starts_with(program + ": ")) said.erase(0, program.size() + 2);
  said.erase(std::find(said.begin(), said.end(), '\n'), said.end());
  return said;
}

/// What one of our programs prints. Throws where it is not there or refuses.
std::string answer(const StudyRun& run, const fs::path& programs, const std::string& name,
                   const std::vector<std::string>& arguments) {
  const fs::path program = fs::absolute(programs / name);
  if (!fs::exists(program))
    throw Error(program.string() +
                ": not found, expected the program that checks the cases of a "
                "study (it is built together with surge-compare)");
  const ProcessEnd end = run_process(program.string(), arguments, fs::current_path(), "none");
  if (end.status != 0) throw Error(run.place + ": " + run.name + ": " + one_line(end.said, name));
  return end.said;
}

json particle_case(const StudyRun& run, const fs::path& programs) {
  if (!fs::is_regular_file(run.case_file))
    refuse(run, "case", in_marks(run.case_path.string()), "an existing case file");
  std::vector<std::string> arguments{"check", run.case_file.string(), "--json"};
  for (const std::string& setting : run.settings) {
    arguments.emplace_back("--set");
    arguments.push_back(setting);
  }
  const std::string said = answer(run, programs, "surge-particle", arguments);
  json resolved = json::parse(said, nullptr, false);
  if (!resolved.is_object() || !resolved.contains("case"))
    throw Error(run.place + ": " + run.name + ": surge-particle check --json printed something " +
                "else than a case: " + one_line(said, ""));
  return resolved;
}

/// Whether a value could stand where another one does: numbers for numbers, finite ones and as
/// many, and none below zero in the place of one that is not.
bool is_like(const json& before, const json& value) {
  const auto finite = [](const json& v) { return v.is_number() && std::isfinite(v.get<double>()); };
  if (before.is_number())
    return finite(value) && (before.get<double>() < 0.0 || value.get<double>() >= 0.0);
  // Words, one or several: the case knows which.
  if (!before.is_array() || !std::all_of(before.begin(), before.end(), finite)) return true;
  return value.is_array() && value.size() == before.size() &&
         std::all_of(value.begin(), value.end(), finite);
}

/// A folder with an OpenFOAM case, whose one dictionary takes all settings.
json foam_folder(const StudyRun& run) {
  const std::string found = in_marks(run.case_path.string());
  if (!fs::is_directory(run.case_file))
    refuse(run, "case", found, "an existing OpenFOAM case, or a case file (.toml)");
  for (const char* file : {"Allrun", "system/caseParameters"})
    if (!fs::is_regular_file(run.case_file / file))
      refuse(run, "case", found + " without " + file,
             "an OpenFOAM case like foam_cases/damBreak2D");
  json parameters = case_parameters(run.case_file);
  for (const std::string& setting : run.settings) {
    const std::string key = setting.substr(0, setting.find('='));
    if (!parameters.contains(key)) {
      std::vector<std::string> known;
      for (const auto& entry : parameters.items()) known.push_back(entry.key());
      const std::string near = nearest(key, known);
      refuse(run, "set", in_marks(setting),
             "an entry of " + (run.case_file / "system/caseParameters").string() +
                 (near.empty() ? "" : " (" + near + "?)"));
    }
    const json value = parameter_value(setting.substr(setting.find('=') + 1));
    if (!is_like(parameters[key], value))
      refuse(run, "set", in_marks(setting),
             "a value like that of the case, " + parameters[key].dump());
    parameters[key] = value;
  }
  return {{"parameters", parameters}};
}

/// A case file that surge-foam makes an OpenFOAM case of.
json foam_case(const StudyRun& run, const fs::path& programs) {
  if (!fs::is_regular_file(run.case_file))
    refuse(run, "case", in_marks(run.case_path.string()), "an existing case file");
  std::vector<std::string> settings, arguments{"check", run.case_file.string(), "--json"};
  for (const std::string& setting : run.settings) {
    const bool foam = setting.starts_with("foam.");
    arguments.emplace_back(foam ? "--foam" : "--set");
    arguments.push_back(foam ? setting.substr(5) : setting);
    if (!foam) settings.push_back(setting);
  }
  const std::string said = answer(run, programs, "surge-foam", arguments);
  const json told = json::parse(said, nullptr, false);
  if (!told.is_object() || !told.contains("size"))
    throw Error(run.place + ": " + run.name + ": surge-foam check --json printed something " +
                "else than a size: " + one_line(said, ""));
  const TomlTable root = TomlTable::read(run.case_file, settings);
  const Case flow = read_case(root);
  check_case(flow, root);
  return {{"case", to_json(flow)}, {"size", told.at("size")}};
}

void check_files(const StudyRun& run) {
  const bool pattern = run.case_file.filename().string().find('*') != std::string::npos;
  if (!pattern && !fs::exists(run.case_file))
    refuse(run, "source", in_marks(run.case_path.string()),
           "an existing folder or file, or a pattern with *");
  if (run.map && !fs::is_regular_file(*run.map))
    refuse(run, "map", in_marks(run.map->string()), "an existing map file");
}

json resolve(const StudyRun& run, const fs::path& programs) {
  if (run.program == "surge-particle") return particle_case(run, programs);
  if (run.is_files()) {
    check_files(run);
    return nullptr;
  }
  try {
    return run.made_from_case_file() ? foam_case(run, programs) : foam_folder(run);
  } catch (const Error& error) {
    const std::string text = error.what();
    throw Error(text.starts_with(run.place) ? text : run.place + ": " + run.name + ": " + text);
  }
}

std::string computation_of(const StudyRun& run) {
  std::string key = run.program + '\n' + run.case_file.string();
  for (const std::string& setting : run.settings) key += '\n' + setting;
  return key;
}

/// What each of the runs computes. A program is started for each, side by side: a sweep may have
/// thousands. The error, where there is one, is that of the first run that has one.
std::vector<json> resolve_all(const std::vector<const StudyRun*>& runs, const fs::path& programs) {
  std::vector<json> answers(runs.size());
  std::vector<std::exception_ptr> errors(runs.size());
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  const auto work = [&] {
    while (!failed) {
      const std::size_t i = next++;
      if (i >= runs.size()) return;
      try {
        answers[i] = resolve(*runs[i], programs);
      } catch (...) {
        errors[i] = std::current_exception();
        failed = true;  // every run before this one has been taken up, and is finished
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t count =
        std::min<std::size_t>(runs.size(), std::max(1U, std::thread::hardware_concurrency()));
    for (std::size_t i = 1; i < count; ++i) workers.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return answers;
}

/// A run as its case describes it, where that is known before the run.
std::optional<Run> described_by_case(const StudyRun& run) {
  if (!run.resolved.is_object() || !run.resolved.contains("case")) return std::nullopt;
  Run described;
  described.name = run.name;
  described.path = run.name;
  described.kind = run.program == "interFoam" ? SourceKind::openfoam : SourceKind::particle_run;
  json stated = run.resolved.at("case");
  if (!stated.contains("method")) stated["method"] = {{"name", "vof"}, {"preset", ""}};
  apply_case(described, stated, run.place + ": " + run.name);
  described.manifest = {{"case", stated}};
  return described;
}

std::optional<Physics> physics_of(const StudyRun& run) {
  const auto described = described_by_case(run);
  return described ? std::optional(described->physics) : std::nullopt;
}

/// That every run whose case is known could be asked for each observable.
void check_observables(const Study& study) {
  if (study.observables.empty()) return;
  std::optional<Run> reference;
  for (const StudyRun& run : study.runs)
    if (run.name == study.reference && run.role == Role::comparison)
      reference = described_by_case(run);
  for (const StudyRun& run : study.runs) {
    if (run.role != Role::comparison) continue;
    const auto described = described_by_case(run);
    if (!described) continue;
    FrontOptions front;
    front.strip_height = study.strip_height;
    for (const StudyObservable& asked : study.observables) {
      if (asked.kind == "overlap" && !reference) continue;
      try {
        check_observable(asked.name, asked.kind, asked.parameters,
                         {*described, front, reference ? &*reference : nullptr});
      } catch (const Error& error) {
        throw Error(asked.place + ": " + error.what());
      }
    }
  }
}

void check_physics(const Study& study) {
  const auto reference =
      std::find_if(study.runs.begin(), study.runs.end(), [&](const StudyRun& run) {
        return run.name == study.reference && run.role == Role::comparison;
      });
  if (reference == study.runs.end()) return;
  const auto theirs = physics_of(*reference);
  if (!theirs) return;
  for (const StudyRun& run : study.runs) {
    if (run.role == Role::verification || run.role == Role::timing) continue;
    const auto ours = physics_of(run);
    if (!ours) continue;
    try {
      std::set<std::string> allowed = run.allowed_differences;
      if (run.role == Role::sensitivity) allowed.insert("wall");
      require_same_physics(compare_physics(*ours, run.name, *theirs, reference->name), allowed);
    } catch (const Error& error) {
      throw Error(run.place + ": " + run.name + ": " + error.what());
    }
  }
}

/// When a run is to end, s; empty where it is not known before.
std::optional<double> end_of(const StudyRun& run) {
  for (const char* name : {"/case/time/end", "/parameters/endTime"}) {
    const json::json_pointer pointer(name);
    if (run.resolved.contains(pointer) && run.resolved.at(pointer).is_number())
      return run.resolved.at(pointer).get<double>();
  }
  return std::nullopt;
}

struct AskedSeries {
  const StudyObservable* observable;
  std::string name;
  ReferenceSeries series;
};

/// The series that observables are held against; throws where one is of another kind.
std::vector<AskedSeries> asked_series(const Study& study, const fs::path& folder) {
  std::vector<AskedSeries> asked;
  for (const StudyObservable& observable : study.observables) {
    for (const std::string& name : observable.references) {
      ReferenceSeries series = read_reference(series_file(study, name, folder), observable_names());
      if (series.observable != observable.kind)
        throw Error(observable.place + ".references: found " + name + ", a series of kind " +
                    series.observable + ", expected one of kind " + observable.kind);
      asked.push_back({&observable, name, std::move(series)});
    }
  }
  return asked;
}

/// That a series is of the case of some run at least: what is of another case is compared with
/// nothing.
void check_cases_of(const std::vector<AskedSeries>& asked, const Study& study) {
  std::vector<std::optional<Physics>> flows;
  for (const StudyRun& run : study.runs)
    if (run.role == Role::comparison) flows.push_back(physics_of(run));
  for (const auto& [observable, name, series] : asked) {
    std::optional<std::string> why;
    const bool compared = std::any_of(flows.begin(), flows.end(), [&, &of = series](auto& flow) {
      why = flow ? other_case(of, *flow) : std::nullopt;
      return !why;
    });
    if (why && !compared)
      throw Error(observable->place + ".references: found " + name + ", " + *why +
                  ", expected a series of the case of one run at least");
  }
}

void check_snapshots(const Study& study) {
  if (study.snapshot_times.empty()) return;
  for (const StudyRun& run : study.runs) {
    if (run.name != study.reference || run.role != Role::comparison) continue;
    const auto end = end_of(run);
    const double last = study.snapshot_times.back().value();
    if (end && last > *end + 1e-9)
      throw Error(study.snapshot_place + ": found " + number_text(last) +
                  ", expected times up to the end of the reference, " + number_text(*end) + " s");
  }
}

}  // namespace

fs::path own_folder() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

void check_study(Study& study, const fs::path& programs, const std::string& only,
                 const fs::path& series_folder) {
  for (const std::string& name : study.published)
    static_cast<void>(read_series(series_file(study, name, series_folder)));
  const std::vector<AskedSeries> asked = asked_series(study, series_folder);
  std::map<std::string, std::size_t> known;
  std::vector<const StudyRun*> different;
  for (const StudyRun& run : study.runs)
    if ((only.empty() || run.name == only) &&
        known.emplace(computation_of(run), different.size()).second)
      different.push_back(&run);
  const std::vector<json> answers = resolve_all(different, programs);
  for (StudyRun& run : study.runs)
    if (only.empty() || run.name == only) run.resolved = answers[known.at(computation_of(run))];
  check_physics(study);
  if (only.empty() && !asked.empty()) check_cases_of(asked, study);
  check_observables(study);
  check_snapshots(study);
}

}  // namespace surge::compare
