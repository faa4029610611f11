#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "particle/io/computation.hpp"
#include "particle/io/presets.hpp"
#include "particle/io/run.hpp"
#include "particle/support/version.hpp"

namespace {

struct Arguments {
  std::string case_file;
  std::vector<std::string> overrides;
  surge::RunOptions run;
  bool options = false;
};

constexpr int exit_interrupted = 130;  // as shells report a program ended by Ctrl-C

int run(const Arguments& arguments) {
  const auto computation = surge::read_computation(arguments.case_file, arguments.overrides);
  const surge::RunEnd end = surge::run_case(computation, arguments.run, std::cout);
  return end == surge::RunEnd::interrupted ? exit_interrupted : 0;
}

void check(const Arguments& arguments) {
  const auto computation = surge::read_computation(arguments.case_file, arguments.overrides);
  const surge::Case& c = computation.flow;
  const surge::CaseSummary summary = surge::summarise(computation);
  std::cout << c.title << "\n  dimension   " << c.dimension << "\n  method      "
            << computation.method_name() << ", preset " << computation.preset << "\n  spacing     "
            << c.spacing << " m\n  particles   " << summary.fluid_particles << " fluid, "
            << summary.wall_particles << " wall\n  end         " << c.time.end
            << " s, a frame every " << c.output_interval << " s\n  steps       about "
            << std::lround(surge::estimated_steps(computation)) << ", the first "
            << summary.first_step << " s\n";
}

void list_options(const surge::Method& method) {
  std::cout << "\n[" << method.name << "]\n";
  for (const surge::OptionText& option : method.describe(method.defaults())) {
    std::cout << "  " << option.name << " = " << option.value << "\n      " << option.description
              << " (" << option.allowed << ")\n";
  }
}

void list(const Arguments& arguments) {
  std::cout << "Presets:\n";
  for (const surge::PresetFile& preset : surge::preset_files()) {
    std::printf("  %-18s %s\n", std::string(preset.name).c_str(),
                surge::preset_description(preset).c_str());
  }
  std::fflush(stdout);
  if (!arguments.options) return;
  for (const surge::Method& method : surge::methods()) list_options(method);
}

std::string version_text() {
  const surge::BuildInfo build = surge::build_info();
  return "surge-particle " + build.version + " (commit " + build.commit + ", " + build.compiler +
         ", " + build.flags + ")";
}

int run_program(int argc, char** argv) {
  CLI::App app{"Free-surface flow with particles", "surge-particle"};
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  Arguments arguments;
  const auto with_case = [&](CLI::App* command) {
    command->add_option("case", arguments.case_file, "case file (TOML)")
        ->required()
        ->type_name("CASE.toml");
    command
        ->add_option("--set", arguments.overrides,
                     "override an entry of the case file; may be repeated")
        ->type_name("table.key=value")
        ->allow_extra_args(false);
  };
  CLI::App* run_command = app.add_subcommand("run", "compute a case and write its run folder");
  with_case(run_command);
  run_command->add_option("--out", arguments.run.folder, "folder of the run")
      ->required()
      ->type_name("DIR");
  run_command->add_option("--threads", arguments.run.threads, "number of threads; 1 by default")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  CLI::App* check_command =
      app.add_subcommand("check", "read and check a case file, and say what it means");
  with_case(check_command);
  CLI::App* list_command = app.add_subcommand("list", "list the presets of the methods");
  list_command->add_flag("--options", arguments.options,
                         "list every option of the methods as well");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    throw surge::Error(std::string(error.what()) + " (surge-particle --help tells the usage)");
  }
  arguments.run.terminal = isatty(STDOUT_FILENO) == 1;
  if (run_command->parsed()) return run(arguments);
  if (check_command->parsed()) check(arguments);
  if (list_command->parsed()) list(arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "surge-particle: " << error.what() << '\n';
    return 1;
  }
}
