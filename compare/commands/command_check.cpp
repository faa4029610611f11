#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/study/baseline.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

struct Arguments {
  std::string run;
  std::string baseline;
  std::string reason;
  bool bless = false;
  bool skip_missing = false;
  double tolerance_front = 0.02;
  double tolerance_time = 0.02;
  SourceArguments files;
  FrontArguments front;
};

void print_findings(const std::vector<Finding>& findings) {
  std::printf("%-16s %-8s %-12s %14s %14s %12s %12s\n", "quantity", "status", "worst at", "found",
              "expected", "deviation", "tolerance");
  for (const Finding& f : findings) {
    std::printf("%-16s %-8s %-12s %14s %14s %12.4g %12.4g\n", f.quantity.c_str(),
                status_text(f.status), f.worst.empty() ? "-" : f.worst.c_str(), f.found.c_str(),
                f.expected.c_str(), f.deviation, f.tolerance);
  }
}

void bless_run(const Arguments& arguments) {
  const Provenance measured = provenance_now(arguments.reason);
  const FrontOptions options = arguments.front.get(std::nullopt);
  const MeasuredRun run = measure(
      open_run(arguments.run, arguments.files.get(std::filesystem::path(arguments.run))), options);
  print_notices(run.run);
  const Tolerances tolerances{DimensionlessLength(arguments.tolerance_front),
                              DimensionlessTime(arguments.tolerance_time)};
  const Baseline baseline = bless(run, options, tolerances, measured);
  write_baseline(arguments.baseline, baseline);
  std::printf("%s: %zu points and %zu values of %s, blessed by %s\n", arguments.baseline.c_str(),
              baseline.front.samples.size(), baseline.scalars.size(), run.run.name.c_str(),
              measured.by.c_str());
}

int check_run(const Arguments& arguments) {
  const Baseline baseline = read_baseline(arguments.baseline);
  if (!std::filesystem::exists(arguments.run) && arguments.skip_missing) {
    std::printf("%s: skipped, there is no such run\n", arguments.run.c_str());
    return exit_skipped;
  }
  FrontOptions options;
  options.strip_height = baseline.strip_height;
  options.linking_length = baseline.linking_length;
  const MeasuredRun run = measure(
      open_run(arguments.run, arguments.files.get(std::filesystem::path(arguments.run))), options);
  print_notices(run.run);
  const std::vector<Finding> findings = check(run, baseline);
  print_findings(findings);
  const auto failed = std::count_if(findings.begin(), findings.end(),
                                    [](const Finding& f) { return f.status != Status::passed; });
  std::printf("%s: %s (%td of %zu quantities outside %s)\n", run.run.name.c_str(),
              failed ? "failed" : "passed", failed, findings.size(), arguments.baseline.c_str());
  return failed ? exit_check_failed : exit_success;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("check", "Holds a run's front against a stored baseline");
  command->add_option("RUN", arguments->run, "run folder, OpenFOAM case or particle files")
      ->required();
  command->add_option("--baseline", arguments->baseline, "baseline (JSON)")->required();
  auto* bless =
      command->add_flag("--bless", arguments->bless, "write the baseline from this run instead");
  command->add_option("--reason", arguments->reason, "why the run is right; goes into the baseline")
      ->needs(bless);
  command->add_option("--tolerance-front", arguments->tolerance_front, "of Z/L, for --bless")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->needs(bless);
  command->add_option("--tolerance-time", arguments->tolerance_time, "of T, for --bless")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->needs(bless);
  command->add_flag("--skip-missing", arguments->skip_missing,
                    "a run folder that does not exist is skipped (exit code 77), not an error");
  arguments->front.add_to(*command);
  for (const char* option : {"--strip-height", "--linking-length", "--raw-maximum"}) {
    command->get_option(option)->needs(bless);
  }
  arguments->files.add_to(*command);
  command->footer(
      "Without --bless the strip and the linking length are those of the baseline.\n"
      "Exit code: 0 passed, 2 failed, 77 skipped, 1 error.\nExamples:\n"
      "  surge-compare check runs/mps-quick --baseline tests/study/mps-quick.json\n"
      "  surge-compare check runs/mps-quick --baseline tests/study/mps-quick.json --bless --reason "
      "\"new kernel\"");
  command->callback([arguments, &exit_code] {
    if (arguments->bless) {
      bless_run(*arguments);
    } else {
      exit_code = check_run(*arguments);
    }
  });
}

}  // namespace surge::compare
