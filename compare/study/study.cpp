#include "compare/study/study.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "particle/support/toml.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 2> programs{"surge-particle", "interFoam"};
/// Papers whose statements can be judged.
constexpr std::array<std::string_view, 1> papers{"alves_dreux"};
constexpr std::array<std::string_view, 5> roles{"comparison", "timing", "sensitivity",
                                                "convergence", "verification"};

StudyRun read_run(const TomlTable& table) {
  StudyRun run;
  run.name = table.text("name");
  if (run.name.empty() || run.name.find_first_of("/\\ \t*") != std::string::npos) {
    throw table.error("name", "\"" + run.name + "\"", "a folder's name without / * or blanks");
  }
  run.program = programs[table.choice("program", programs)];
  run.case_path = table.text("case");
  if (table.has("set")) run.settings = table.texts("set");
  for (const std::string& setting : run.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw table.error("set", "\"" + setting + "\"", "\"key=value\"");
  }
  run.threads = static_cast<int>(table.integer_or("threads", 1, surge::Bounds::closed(1, 4096)));
  if (table.has("role")) run.role = static_cast<Role>(table.choice("role", roles));
  run.group = table.text_or("group", "");
  if (run.group.empty() && run.role != Role::comparison && run.role != Role::timing) {
    throw table.error("group", table.has("group") ? "\"\"" : "nothing",
                      "what a run of role " + std::string(role_text(run.role)) + " belongs to");
  }
  // Of no concern here: compare/studies/study.py, which schedules the runs, goes by them.
  static_cast<void>(table.boolean_or("timed", true));
  static_cast<void>(table.boolean_or("may_break", false));
  return run;
}

/// A study that is being put together from its files.
class Collector {
 public:
  /// A file that was read before, however it is reached, adds nothing.
  void add_file(const fs::path& file) {
    if (!files_.insert(fs::weakly_canonical(file)).second) return;
    const TomlTable root = TomlTable::read(file);
    read_head(root);
    if (root.has("include")) {
      for (const std::string& name : root.texts("include")) {
        const fs::path included = file.parent_path() / name;
        if (!fs::is_regular_file(included))
          throw root.error("include", "\"" + name + "\"", "a study, named relative to this file");
        add_file(included);
      }
    }
    for (const TomlTable& table : root.tables("run")) add_repeats(table);
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
    require(root, "strip_height", strip_height_.has_value());
    require(root, "snapshot_times", snapshot_times_.has_value());
    study_.reference = *reference_;
    study_.strip_height = *strip_height_;
    study_.snapshot_times = *snapshot_times_;
    if (published_) study_.published = *published_;
    if (claims_) study_.claims = *claims_;
    const auto is_reference = [&](const StudyRun& run) {
      return run.name == study_.reference && run.role == Role::comparison;
    };
    if (std::none_of(study_.runs.begin(), study_.runs.end(), is_reference)) {
      throw Error(reference_place_ + ": found \"" + study_.reference +
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
      if (!reference_) reference_place_ = root.place("reference");
      keep(reference_, root.text("reference"));
    }
    if (root.has("strip_height"))
      keep(strip_height_, Metres(root.number("strip_height", surge::Bounds::above(0.0))));
    if (root.has("snapshot_times")) keep(snapshot_times_, increasing_times(root));
    if (root.has("published")) keep(published_, root.texts("published"));
    if (root.has("claims")) keep(claims_, std::string(papers[root.choice("claims", papers)]));
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

  void add_repeats(const TomlTable& table) {
    StudyRun run = read_run(table);
    const std::string name = run.name;
    const auto repeats = table.integer_or("repeats", 1, surge::Bounds::closed(1, 99));
    for (long k = 1; k <= repeats; ++k) {
      if (k > 1) run.name = name + "-repeat" + std::to_string(k);
      add(run, table);
    }
  }

  void add(const StudyRun& run, const TomlTable& table) {
    for (const StudyRun& other : study_.runs) {
      if (other.name != run.name) continue;
      if (!other.computes_the_same_as(run)) {
        throw table.error("name", "\"" + run.name + "\" a second time, for another computation",
                          "different names, or the same program, case, set and threads");
      }
      if (other == run) return;
    }
    study_.runs.push_back(run);
  }

  Study study_;
  std::set<fs::path> files_;
  std::optional<std::string> title_, reference_, claims_;
  std::string reference_place_;
  std::optional<Metres> strip_height_;
  std::optional<std::vector<Seconds>> snapshot_times_;
  std::optional<std::vector<std::string>> published_;
};

}  // namespace

std::string_view role_text(Role role) {
  return roles[static_cast<std::size_t>(role)];
}

bool StudyRun::computes_the_same_as(const StudyRun& other) const {
  return program == other.program && case_path == other.case_path && settings == other.settings &&
         threads == other.threads;
}

Study read_study(const fs::path& file) {
  Collector study;
  study.add_file(file);
  return study.finished(file);
}

}  // namespace surge::compare
