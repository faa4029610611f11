#include <cmath>
#include <cstdio>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/commands/output.hpp"
#include "compare/commands/tolerances.hpp"
#include "compare/figures/check_figure.hpp"
#include "compare/study/baseline_check.hpp"
#include "compare/study/check_output.hpp"
#include "particle/support/bounds.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

struct CheckInput {
  std::string source;
  std::string baseline;
  std::string reason, because;
  std::string junit, json, figure;
  std::vector<std::string> observables, absolute, relative, time;
  std::optional<double> until, wall_distance;
  bool bless = false;
  bool skip_missing = false;
  bool quiet = false;
  SourceArguments files;
  FrontArguments front;
};

std::string window_text(const Baseline& baseline) {
  return number_text(baseline.from) + " s to " + number_text(baseline.until) +
         " s: " + baseline.because;
}

/// Notices of the source and of what was measured, on the standard error as well.
std::vector<std::string> tell_notices(const ObservedRun& source) {
  std::vector<std::string> all = source.run.notices;
  for (const Findings& found : source.found)
    all.insert(all.end(), found.notices.begin(), found.notices.end());
  for (const std::string& notice : all)
    std::fprintf(stderr, "%s: notice: %s\n", source.run.name.c_str(), notice.c_str());
  return all;
}

/// What stands in the baseline is blessed again where nothing else is asked for.
void keep_choices(const Baseline& before, std::vector<std::string>& observables,
                  BlessOptions& options, const CheckInput& arguments) {
  if (observables.empty()) {
    observables = before.observables();
    for (const BaselineCurve& curve : before.curves) {
      options.absolute.emplace(curve.series, curve.tolerance.absolute);
      options.relative.emplace(curve.series, curve.tolerance.relative);
      options.time.emplace(curve.series, curve.tolerance.time);
    }
  }
  if (!arguments.until && !arguments.wall_distance) {
    options.until = Seconds(before.until);
    options.because = before.because;
  }
  if (!arguments.front.given()) options.front = before.front;
}

void bless_run(const CheckInput& arguments) {
  const Provenance measured = provenance_now(arguments.reason);
  const fs::path file = arguments.baseline, path = arguments.source;
  BlessOptions options;
  options.front = arguments.front.get(std::nullopt);
  std::vector<std::string> observables = arguments.observables;
  options.absolute = read_tolerances("--absolute", arguments.absolute);
  options.relative = read_tolerances("--relative", arguments.relative);
  options.time = read_tolerances("--time", arguments.time);
  if (arguments.until) options.until = Seconds(*arguments.until);
  options.because = arguments.because.empty() ? "--until" : arguments.because;
  if (arguments.wall_distance)
    options.wall_distance = DimensionlessLength(*arguments.wall_distance);
  std::optional<Baseline> before;
  SourceOptions stored;
  if (fs::exists(file)) {
    before = read_baseline(file);
    keep_choices(*before, observables, options, arguments);
    stored = stored_options(*before, path, file.string());
  }
  if (observables.empty()) observables.emplace_back("front");
  const SourceOptions files = arguments.files.get(path, stored);
  ObservedRun source = observe(open_run(path, files), options.front, observables);
  Baseline baseline = bless(source, options, measured);
  baseline.read = options_to_store(files, source.run.path);
  (void)tell_notices(source);
  if (before) {
    CheckReport changes{source.run.name,
                        "the former " + file.string(),
                        window_text(*before),
                        check(source, *before).findings,
                        {},
                        ""};
    write_table(std::cout, changes);
  }
  write_baseline(file, baseline);
  std::size_t points = 0;
  for (const BaselineCurve& curve : baseline.curves) {
    points += curve.at.size();
    std::printf("%s: %zu points within %s %s or %s of the value, %s s\n", curve.name().c_str(),
                curve.at.size(), number_text(curve.tolerance.absolute).c_str(), curve.unit.c_str(),
                number_text(curve.tolerance.relative).c_str(),
                number_text(curve.tolerance.time).c_str());
  }
  std::printf("window: %s\n%s: %zu points and %zu values of %s, blessed by %s\n",
              window_text(baseline).c_str(), file.c_str(), points, baseline.values.size(),
              source.run.name.c_str(), measured.by.c_str());
}

void write_files(const CheckInput& arguments, const CheckReport& report) {
  if (!arguments.junit.empty())
    write_to(arguments.junit, [&](std::ostream& out) { write_junit(out, {report}); });
  if (!arguments.json.empty())
    write_to(arguments.json, [&](std::ostream& out) { out << dump(to_json(report)) << '\n'; });
}

int check_run(const CheckInput& arguments) {
  const Baseline baseline = read_baseline(arguments.baseline);
  const fs::path path = arguments.source;
  CheckReport report{run_name(path), arguments.baseline, window_text(baseline), {}, {}, ""};
  if (!fs::exists(path) && arguments.skip_missing) {
    report.findings.push_back({"source", Status::skipped, "", "missing", "a run", "", 0, 0, ""});
    write_files(arguments, report);
    std::printf("%s: skipped, there is no such run\n", arguments.source.c_str());
    return exit_skipped;
  }
  CheckResult checked;
  try {
    const SourceOptions files =
        arguments.files.get(path, stored_options(baseline, path, arguments.baseline));
    const ObservedRun source =
        observe(open_run(path, files), baseline.front, baseline.observables());
    report.notices = tell_notices(source);
    checked = check(source, baseline);
    report.findings = checked.findings;
  } catch (const Error& error) {
    // A service must learn of it as well.
    report.error = error.what();
    write_files(arguments, report);
    throw;
  }
  write_files(arguments, report);
  if (!arguments.figure.empty()) {
    const std::string warnings = draw_check(checked.curves, arguments.figure);
    if (!warnings.empty()) std::fprintf(stderr, "surge-compare: figure: %s", warnings.c_str());
  }
  if (!arguments.quiet && arguments.json != "-" && arguments.junit != "-")
    write_table(std::cout, report);
  return report.passed() ? exit_success : exit_check_failed;
}

void add_bless_options(CLI::App& command, CheckInput& arguments) {
  const std::string group = "With --bless";
  auto* bless = command.add_flag("--bless", arguments.bless,
                                 "write the baseline from this source instead; the only way to "
                                 "change one");
  bless->group(group);
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->group(group)->needs(bless);
  };
  add("--reason", arguments.reason, "why the source is right; goes into the baseline");
  add("--observable", arguments.observables,
      "what to hold, as in surge-compare measure; again for each [front]")
      ->type_size(1)
      ->allow_extra_args(false);
  for (auto [name, list, help] :
       {std::tuple{"--absolute", &arguments.absolute,
                   "how far values may be off, in their unit, RESULT=VALUE for one of several "
                   "[front 0.02 L, others 0.02 of their largest]"},
        std::tuple{"--relative", &arguments.relative,
                   "the same as a part of the value; the larger of both holds"},
        std::tuple{"--time", &arguments.time, "how early or late a curve may be, s"}})
    add(name, *list, help)->take_all()->allow_extra_args(false);
  auto* until =
      add("--until", arguments.until, "end of the window, s [the front near the far wall]");
  add("--because", arguments.because, "why the flow is not comparable any more after --until")
      ->needs(until);
  add("--wall-distance", arguments.wall_distance,
      "the window ends where the front is this near to the far wall, in L [0.1]")
      ->check(CLI::NonNegativeNumber)
      ->excludes(until);
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<CheckInput>();
  CLI::App* command =
      app.add_subcommand("check", "Holds a source's observables against a stored baseline");
  command
      ->add_option("SOURCE", arguments->source,
                   "run folder, OpenFOAM case, .pvd, folder or pattern of particle files")
      ->required();
  command->add_option("--baseline", arguments->baseline, "baseline (JSON)")->required();
  command->add_flag("--skip-missing", arguments->skip_missing,
                    "a source that does not exist is skipped (exit code 77), not an error");
  command->add_flag("--quiet", arguments->quiet, "print no table; the exit code tells the verdict");
  command->add_option("--junit-xml", arguments->junit,
                      "file to write for a CI service; - for standard output");
  command->add_option("--json", arguments->json, "file to write; - for standard output");
  command->add_option("--figure", arguments->figure,
                      "file to draw to (SVG): what was found over what is expected");
  add_bless_options(*command, *arguments);
  arguments->front.add_to(*command);
  for (CLI::Option* option : command->get_options())
    if (option->get_group() == "Leading edge") option->needs(command->get_option("--bless"));
  arguments->files.add_to(*command);
  command->footer(
      "The baseline states observables, tolerances, window and how its source was read; a check "
      "needs none\nof these options, and --bless of a file that exists keeps what is not said "
      "anew.\n"
      "Exit code: 0 passed, 2 failed, 77 skipped, 1 nothing could be compared.\nExamples:\n"
      "  surge-compare check out --baseline mine.json --map mine.toml --tank-width 0.58 \\\n"
      "    --observable front --observable gauge:x=0.3 --absolute gauge:x=0.3=0.004 --bless "
      "--reason \"agrees with VOF\"\n"
      "  surge-compare check out --baseline mine.json --junit-xml check.xml --figure check.svg");
  command->callback([arguments, &exit_code] {
    if (arguments->bless) {
      bless_run(*arguments);
    } else {
      exit_code = check_run(*arguments);
    }
  });
}

}  // namespace surge::compare
