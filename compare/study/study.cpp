#include "compare/study/study.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "compare/measure/front.hpp"
#include "compare/study/run_table.hpp"
#include "particle/support/toml.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

/// The folder NAME beside the study, or in compare/studies of the working folder.
fs::path claims_folder(const TomlTable& root, const std::string& name) {
  for (const fs::path& parent : {root.folder(), fs::path("compare/studies")})
    if (fs::is_regular_file(parent / name / "claims.toml")) return parent / name;
  throw root.error("claims", "\"" + name + "\"",
                   "the name of a folder beside this file that has a claims.toml");
}

/// A study that is being put together from its files.
class Collector {
 public:
  /// A file that was read before, however it is reached, adds nothing.
  void add_file(const fs::path& file) {
    if (!files_.insert(fs::weakly_canonical(file)).second) return;
    study_.files.push_back(file);
    const TomlTable root = TomlTable::read(file);
    read_head(root);
    if (root.has("include")) {
      for (const std::string& name : root.texts("include")) {
        const fs::path included = (file.parent_path() / name).lexically_normal();
        if (!fs::is_regular_file(included))
          throw root.error("include", "\"" + name + "\"", "a study, named relative to this file");
        add_file(included);
      }
    }
    const std::optional<TomlTable> defaults = root.optional_table("defaults");
    if (defaults) check_defaults(*defaults);
    if (study_.observables.empty()) study_.observables = read_observables(root);
    for (const TomlTable& table : root.tables("run"))
      for (const StudyRun& run : read_runs(table, defaults)) add(run, table);
    root.finish();
  }

  Study finished(const fs::path& file) {
    const TomlTable root = TomlTable::read(file);
    if (study_.runs.empty()) throw root.error("run", "no run", "at least one [[run]]");
    require(root, "title", title_.has_value());
    study_.title = *title_;
    // Exact answers need no reference run.
    if (std::all_of(study_.runs.begin(), study_.runs.end(),
                    [](const StudyRun& run) { return run.role == Role::verification; }))
      return std::move(study_);
    require(root, "reference", reference_.has_value());
    if (asks_for_front(study_)) require(root, "strip_height", strip_height_.has_value());
    require(root, "snapshot_times", snapshot_times_.has_value());
    study_.reference = *reference_;
    study_.strip_height = strip_height_.value_or(FrontOptions{}.strip_height);
    study_.snapshot_times = *snapshot_times_;
    if (published_) study_.published = *published_;
    if (claims_) study_.claims = *claims_;
    const auto is_reference = [&](const StudyRun& run) {
      return run.name == study_.reference && run.role == Role::comparison;
    };
    if (std::none_of(study_.runs.begin(), study_.runs.end(), is_reference)) {
      throw Error(study_.reference_place + ": found \"" + study_.reference +
                  "\", expected the name of one of the runs of role comparison");
    }
    return std::move(study_);
  }

 private:
  static void require(const TomlTable& root, const char* key, bool found) {
    if (!found) throw root.error(key, "nothing", "an entry here or in an included study");
  }

  void read_head(const TomlTable& root) {
    if (root.has("title")) keep(title_, root.text("title"));
    if (root.has("reference")) {
      if (!reference_) study_.reference_place = root.place("reference");
      keep(reference_, root.text("reference"));
    }
    if (root.has("strip_height"))
      keep(strip_height_, Metres(root.number("strip_height", surge::Bounds::above(0.0))));
    if (root.has("snapshot_times")) {
      if (!snapshot_times_) study_.snapshot_place = root.place("snapshot_times");
      keep(snapshot_times_, increasing_times(root));
    }
    if (root.has("published")) {
      if (!published_) study_.published_place = root.place("published");
      keep(published_, root.texts("published"));
    }
    if (root.has("claims") && !claims_) {
      claims_ = root.text("claims");
      study_.statements = read_statements(claims_folder(root, *claims_));
    }
  }

  static std::vector<Seconds> increasing_times(const TomlTable& root) {
    std::vector<Seconds> times;
    for (const double t :
         root.numbers("snapshot_times", std::nullopt, surge::Bounds::at_least(0.0))) {
      if (!times.empty() && Seconds(t) <= times.back())
        throw root.error("snapshot_times", number_text(t), "increasing times");
      times.emplace_back(t);
    }
    return times;
  }

  /// The first file that has an entry decides.
  template <class T>
  static void keep(std::optional<T>& entry, T found) {
    if (!entry) entry = std::move(found);
  }

  void add(const StudyRun& run, const TomlTable& table) {
    for (const StudyRun& other : study_.runs) {
      if (other.name != run.name) continue;
      if (!other.computes_the_same_as(run)) {
        throw table.error("name", "\"" + run.name + "\" a second time, for another computation",
                          "different names, or the same program, case, set and threads");
      }
      if (other.role == run.role && other.group == run.group) return;
    }
    study_.runs.push_back(run);
  }

  Study study_;
  std::set<fs::path> files_;
  std::optional<std::string> title_, reference_, claims_;
  std::optional<Metres> strip_height_;
  std::optional<std::vector<Seconds>> snapshot_times_;
  std::optional<std::vector<std::string>> published_;
};

}  // namespace

bool StudyRun::computes_the_same_as(const StudyRun& other) const {
  return program == other.program && case_path == other.case_path && settings == other.settings &&
         threads == other.threads && map == other.map && read == other.read;
}

fs::path series_file(const Study& study, const std::string& name, const fs::path& folder) {
  std::vector<fs::path> places;
  if (!folder.empty()) {
    places.push_back(folder / (name + ".csv"));
  } else {
    for (const fs::path& file : study.files) {
      places.push_back(file.parent_path() / (name + ".csv"));
      places.push_back(file.parent_path() / ".." / "reference" / (name + ".csv"));
    }
    places.push_back(fs::path("compare/reference") / (name + ".csv"));
  }
  for (const fs::path& place : places)
    if (fs::is_regular_file(place)) return place.lexically_normal();
  std::string asker = study.published_place;
  for (const StudyObservable& observable : study.observables)
    if (std::count(observable.references.begin(), observable.references.end(), name) > 0)
      asker = observable.place + ".references";
  throw Error(asker + ": found \"" + name + "\", expected the name of a series: " +
              places.back().parent_path().string() + "/NAME.csv, or NAME.csv beside the study");
}

std::vector<std::string> named_series(const Study& study) {
  std::vector<std::string> names = study.published;
  for (const StudyObservable& observable : study.observables)
    for (const std::string& name : observable.references)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

bool asks_for_front(const Study& study) {
  return study.observables.empty() ||
         std::any_of(study.observables.begin(), study.observables.end(),
                     [](const StudyObservable& one) { return one.kind == "front"; });
}

Study read_study(const fs::path& file) {
  Collector study;
  study.add_file(file);
  return study.finished(file);
}

}  // namespace surge::compare
