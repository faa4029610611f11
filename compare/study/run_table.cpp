#include "compare/study/run_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "compare/read/physics_keys.hpp"
#include "compare/study/sweep.hpp"
#include "particle/support/printable.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> programs{"surge-particle", "interFoam", "files"};
constexpr std::array<std::string_view, 5> roles{"comparison", "timing", "sensitivity",
                                                "convergence", "verification"};
constexpr int most_threads = 4096;

bool is_word(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code >= 0x80 || std::isalnum(code) != 0;  // letters of other alphabets are letters
}

std::string read_name(const TomlTable& table, const Combination& values) {
  const std::string name = values.filled(table, "name", table.text("name"));
  const bool good = !name.empty() && is_word(name.front()) && name.size() <= 200 &&
                    std::all_of(name.begin(), name.end(), [](char c) {
                      return is_word(c) || c == '.' || c == '_' || c == '-';
                    });
  if (!good)
    throw table.error("name", "\"" + name + "\"",
                      "a name of letters, digits, '.', '_' and '-', a folder's");
  return name;
}

/// A run's table, and what stands for the keys that it lacks.
class RunTable {
 public:
  RunTable(const TomlTable& own, const std::optional<TomlTable>& defaults)
      : own_(own), defaults_(defaults) {}
  [[nodiscard]] const TomlTable& own() const { return own_; }
  /// The table that has the key, the run's own where neither has.
  [[nodiscard]] const TomlTable& with(std::string_view key) const {
    return !own_.has(key) && defaults_ && defaults_->has(key) ? *defaults_ : own_;
  }

 private:
  const TomlTable& own_;
  const std::optional<TomlTable>& defaults_;
};

int read_threads(const TomlTable& table, const Combination& values) {
  const auto bounds = surge::Bounds::closed(1, most_threads);
  if (const std::string* text = values.find("threads")) {
    int threads = 0;
    const char* last = text->data() + text->size();
    const auto [end, failed] = std::from_chars(text->data(), last, threads);
    if (failed != std::errc() || end != last || !bounds.contain(threads))
      throw table.error("sweep", "\"" + *text + "\" threads", "a whole number " + bounds.text());
    return threads;
  }
  return static_cast<int>(table.integer_or("threads", 1, bounds));
}

/// A dictionary of OpenFOAM takes a value as it is, where ; ends an entry and # and $ start
/// directives.
bool is_foam_setting(const std::string& setting) {
  const auto equals = setting.find('=');
  const auto ascii = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  return std::isalpha(static_cast<unsigned char>(setting.front())) != 0 &&
         equals + 1 < setting.size() &&
         std::all_of(setting.begin(), setting.begin() + static_cast<std::ptrdiff_t>(equals),
                     [&](char c) { return ascii(c) || c == '_' || c == '.'; }) &&
         std::all_of(setting.begin() + static_cast<std::ptrdiff_t>(equals) + 1, setting.end(),
                     [&](char c) {
                       return ascii(c) || std::string_view("_ .+-()").find(c) != std::string::npos;
                     });
}

void check_settings(const TomlTable& table, const StudyRun& run) {
  for (const std::string& setting : run.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos || equals == 0 || setting.find_first_of(" \t\n") < equals)
      throw table.error("set", "\"" + setting + "\"", "\"key=value\"");
    const bool foams =
        run.program == "interFoam" && (!run.made_from_case_file() || setting.starts_with("foam."));
    if (foams && !is_foam_setting(setting)) {
      throw table.error("set", "\"" + printable(setting) + "\"",
                        "\"name=value\" of letters, digits, blanks and . + - ( ) _, which a "
                        "dictionary takes as it is");
    }
  }
}

void read_computation(const RunTable& table, const Combination& values, StudyRun& run) {
  const TomlTable& cases = table.with("case");
  run.case_path = values.filled(cases, "case", cases.text("case"));
  run.case_file = place_of(cases.folder(), run.case_path);
  run.settings = values.settings(table.own());
  run.threads = read_threads(table.with("threads"), values);
  run.timed = table.with("timed").boolean_or("timed", true);
  run.may_break = table.with("may_break").boolean_or("may_break", false);
  check_settings(table.own(), run);
}

void read_files(const TomlTable& table, const Combination& values, StudyRun& run) {
  run.case_path = values.filled(table, "source", table.text("source"));
  run.case_file = place_of(table.folder(), run.case_path);
  run.timed = false;
  if (table.has("map"))
    run.map = place_of(table.folder(), values.filled(table, "map", table.text("map")));
  // Of files nothing is to be computed: what is known of them beforehand is what they cost.
  if (table.has("cpu_s")) run.resolved["cpu_s"] = table.number("cpu_s", surge::Bounds::above(0.0));
  const auto options = table.optional_table("read");
  if (!options) return;
  for (const std::string& key : options->keys()) {
    const bool name =
        key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos &&
        !key.starts_with("-");
    if (!name) throw options->error(key, "\"" + key + "\"", "an option without its dashes");
    run.read.emplace_back(key, options->scalar(key));
  }
}

/// Differences between levels are taken for errors of discretization; where they are of the case
/// too, the uncertainty holds both. Anywhere else another case is no result of this one.
void read_allowed(const TomlTable& table, StudyRun& run) {
  if (!table.has("allow")) return;
  if (run.role != Role::convergence)
    throw table.error("allow", "role " + std::string(role_text(run.role)), "role convergence");
  for (const std::string& key : table.texts("allow")) {
    if (!is_physics_key(key))
      throw table.error("allow", '"' + key + '"', "names out of " + physics_keys());
    run.allowed_differences.insert(key);
  }
}

StudyRun read_run(const RunTable& table, const Combination& values) {
  StudyRun run;
  const TomlTable& own = table.own();
  run.place = own.place("");
  run.name = read_name(own, values);
  run.program = programs[table.with("program").choice("program", programs)];
  if (run.program == "files") {
    read_files(own, values, run);
  } else {
    read_computation(table, values, run);
  }
  if (const TomlTable& its = table.with("role"); its.has("role"))
    run.role = static_cast<Role>(its.choice("role", roles));
  read_allowed(own, run);
  const TomlTable& groups = table.with("group");
  run.group = values.filled(groups, "group", groups.text_or("group", ""));
  if (run.group.empty() && run.role != Role::comparison && run.role != Role::timing) {
    throw own.error("group", own.has("group") ? "\"\"" : "nothing",
                    "what a run of role " + std::string(role_text(run.role)) + " belongs to");
  }
  return run;
}

}  // namespace

std::string_view role_text(Role role) {
  return roles[static_cast<std::size_t>(role)];
}

fs::path place_of(const fs::path& folder, const fs::path& named) {
  std::error_code ignored;
  const fs::path beside = folder / named;
  // A pattern is looked for by its folder.
  const bool pattern = named.filename().string().find('*') != std::string::npos;
  return fs::exists(pattern ? beside.parent_path() : beside, ignored) ? beside.lexically_normal()
                                                                      : named;
}

std::vector<StudyRun> read_runs(const TomlTable& own, const std::optional<TomlTable>& defaults) {
  const RunTable table(own, defaults);
  std::vector<StudyRun> runs;
  const std::vector<Combination> combinations = read_sweep(own);
  const long repeats = table.with("repeats").integer_or("repeats", 1, surge::Bounds::closed(1, 99));
  for (const Combination& values : combinations) {
    StudyRun run = read_run(table, values);
    const std::string name = run.name;
    if (std::any_of(runs.begin(), runs.end(), [&](const auto& r) { return r.name == name; })) {
      throw own.error("name", "\"" + name + "\" for two runs of the sweep",
                      "a {key} of the sweep that tells them apart");
    }
    for (long k = 1; k <= repeats; ++k) {
      if (k > 1) run.name = name + "-repeat" + std::to_string(k);
      runs.push_back(run);
    }
  }
  return runs;
}

void check_defaults(const TomlTable& defaults) {
  // Asked for here, so that one that no run needs is not unknown.
  if (defaults.has("program")) static_cast<void>(defaults.choice("program", programs));
  if (defaults.has("role")) static_cast<void>(defaults.choice("role", roles));
  for (const char* key : {"case", "group"})
    if (defaults.has(key)) static_cast<void>(defaults.text(key));
  for (const char* key : {"timed", "may_break"}) static_cast<void>(defaults.boolean_or(key, true));
  for (const char* key : {"threads", "repeats"})
    static_cast<void>(defaults.integer_or(key, 1, surge::Bounds::at_least(1)));
}

}  // namespace surge::compare
