#include "compare/study.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "particle/support/toml.hpp"

namespace surge::compare {
namespace {

constexpr std::array<std::string_view, 2> programs{"surge-particle", "interFoam"};

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
  run.timing = table.boolean_or("timing", false);
  // Of no concern here: compare/studies/study.py, which schedules the runs, goes by them.
  static_cast<void>(table.boolean_or("timed", true));
  static_cast<void>(table.boolean_or("may_break", false));
  return run;
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
  const TomlTable root = TomlTable::read(file);
  Study study;
  study.title = root.text("title");
  study.reference = root.text("reference");
  study.strip_height = Metres(root.number("strip_height", surge::Bounds::above(0.0)));
  for (const double t :
       root.numbers("snapshot_times", std::nullopt, surge::Bounds::at_least(0.0))) {
    if (!study.snapshot_times.empty() && Seconds(t) <= study.snapshot_times.back()) {
      throw root.error("snapshot_times", number_text(t), "increasing times");
    }
    study.snapshot_times.emplace_back(t);
  }
  if (root.has("published")) study.published = root.texts("published");
  std::set<std::string> names;
  for (const TomlTable& table : root.tables("run")) {
    const StudyRun first = read_run(table);
    const auto repeats = table.integer_or("repeats", 1, surge::Bounds::closed(1, 99));
    for (long k = 1; k <= repeats; ++k) {
      StudyRun run = first;
      if (k > 1) run.name += "-repeat" + std::to_string(k);
      if (!names.insert(run.name).second)
        throw table.error("name", "\"" + run.name + "\" a second time", "different names");
      study.runs.push_back(std::move(run));
    }
  }
  if (study.runs.empty()) throw root.error("run", "no run", "at least one [[run]]");
  const auto is_reference = [&](const StudyRun& run) {
    return run.name == study.reference && !run.timing;
  };
  if (std::none_of(study.runs.begin(), study.runs.end(), is_reference)) {
    throw root.error("reference", "\"" + study.reference + "\"", "the name of one of the runs");
  }
  root.finish();
  return study;
}

}  // namespace surge::compare
