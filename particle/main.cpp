#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "particle/case/case_keys.hpp"
#include "particle/io/computation.hpp"
#include "particle/io/new_case.hpp"
#include "particle/io/presets.hpp"
#include "particle/io/restart_error.hpp"
#include "particle/io/run.hpp"
#include "particle/io/run_size.hpp"
#include "particle/support/command_line.hpp"
#include "particle/support/file_size_limit.hpp"
#include "particle/support/freed_memory.hpp"
#include "particle/support/new_file.hpp"
#include "particle/support/passive_waiting.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/version.hpp"

namespace {

struct Arguments {
  std::string case_file;
  std::vector<std::string> overrides;
  surge::RunOptions run;
  bool options = false;
  bool json = false;
  bool quiet = false;
  std::string new_file;
  int dimension = 2;
  std::string plotted;
  std::vector<std::string> plot_options;
};

constexpr int exit_interrupted = 130;  // as shells report a program ended by Ctrl-C
constexpr int exit_no_restart = 3;

int run(const Arguments& arguments) {
  const auto computation = surge::read_computation(arguments.case_file, arguments.overrides);
  std::ostream out(arguments.quiet ? nullptr : std::cout.rdbuf());
  for (const std::string& note : surge::notes_on(computation)) out << "note: " << note << '\n';
  const surge::RunEnd end = surge::run_case(computation, arguments.run, out);
  return end == surge::RunEnd::interrupted ? exit_interrupted : 0;
}

void check(const Arguments& arguments) {
  const auto computation = surge::read_computation(arguments.case_file, arguments.overrides);
  const surge::Case& c = computation.flow;
  const surge::RunSize size = surge::run_size(computation);
  if (arguments.json) {
    const nlohmann::json j{{"case", to_json(computation)}, {"size", to_json(size)}};
    std::cout << j.dump(2) << '\n';
    return;
  }
  const auto text = [](double value) { return surge::number_text(value); };
  std::cout << surge::printable(c.title) << "\n  dimension   " << c.dimension << "\n  method      "
            << computation.method_name() << ", preset " << computation.preset << "\n  spacing     "
            << text(c.spacing) << " m\n  particles   " << text(size.particles.fluid) << " fluid, "
            << text(size.particles.wall) << " wall\n  end         " << text(c.time.end) << " s, "
            << text(size.frames) << " frames, one every " << text(c.output_interval)
            << " s\n  steps       about " << text(size.steps) << ", the first "
            << text(size.first_step) << " s\n  memory      about " << surge::bytes_text(size.memory)
            << "\n  disk        about " << surge::bytes_text(size.disk) << '\n';
  for (const std::string& note : surge::notes_on(computation))
    std::cout << "note: " << note << '\n';
}

void make_case(const Arguments& arguments) {
  surge::write_new_file(arguments.new_file, surge::new_case_text(arguments.dimension));
  if (arguments.new_file == "-") return;
  const std::string name = surge::printable(arguments.new_file);
  std::cout << "written to " << name << "; next: surge-particle check " << name << '\n';
}

/// Becomes the program that draws, which is installed beside this one.
[[noreturn]] void plot(const Arguments& arguments) {
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "surge-compare";
  std::vector<std::string> words{program.string(), "plot", arguments.plotted};
  words.insert(words.end(), arguments.plot_options.begin(), arguments.plot_options.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  throw surge::Error(program.string() + ": " + std::strerror(errno) +
                     "; expected surge-compare there, which draws");
}

void list_keys() {
  std::cout << "\nTables and keys of a case file (value, unit; what stands for a missing one):\n";
  std::string_view table = "-";
  for (const surge::CaseKey& key : surge::case_keys()) {
    if (key.table != table && !key.table.empty()) std::cout << "  " << key.table << '\n';
    table = key.table;
    const std::string indent(key.table.empty() ? 2 : 4, ' ');
    std::cout << indent << key.key << " = " << key.takes;
    if (!key.does.empty()) std::cout << "   # " << key.does;
    std::cout << '\n';
  }
  std::cout
      << "  [search]\n    neighbours = cell_grid | all_pairs; cell_grid\n  [method]\n    name = ";
  for (const surge::Method& method : surge::methods())
    std::cout << (&method == surge::methods().data() ? "" : " | ") << method.name;
  std::cout << "\n    preset = see above; paper\n  [NAME OF THE METHOD]\n"
               "    its options: surge-particle list --options\n";
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
  list_keys();
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
  auto* restart = run_command->add_flag(
      "--restart", arguments.run.restart,
      "go on from DIR's checkpoint; same case and settings, same results to the last bit");
  run_command
      ->add_flag("--force", arguments.run.force,
                 "replace the run that DIR holds; without it none is overwritten")
      ->excludes(restart);
  run_command->add_flag("--quiet", arguments.quiet, "print errors and nothing else");
  run_command->footer(
      "A run keeps a checkpoint every output.checkpoint seconds (600), and where Ctrl-C or SIGTERM "
      "stops it\nafter the present step; a second signal ends it at once.\n"
      "Exit status: 0 finished; 1 error; 3 --restart was refused, DIR is as it was; 130 stopped.");
  CLI::App* check_command =
      app.add_subcommand("check", "read and check a case file, and say what it means");
  with_case(check_command);
  check_command->add_flag("--json", arguments.json,
                          "print the case as it was resolved, and the size of the run, as JSON");
  CLI::App* list_command =
      app.add_subcommand("list", "list the presets, and the tables and keys of a case file");
  list_command->add_flag("--options", arguments.options,
                         "list every option of the methods as well");
  CLI::App* new_command =
      app.add_subcommand("new", "write a commented case file to start from, a small dam break");
  new_command->add_option("file", arguments.new_file, "case file to write; - for standard output")
      ->required()
      ->type_name("CASE.toml");
  new_command->add_option("--dimension", arguments.dimension, "2 or 3; 2 by default")
      ->type_name("N");
  CLI::App* plot_command = app.add_subcommand(
      "plot", "picture (PNG) of one frame of a run, drawn by surge-compare plot");
  plot_command->add_option("run", arguments.plotted, "folder of the run")
      ->required()
      ->type_name("RUN");
  const auto hand_on = [&](const std::string& name, const std::string& type, const char* text) {
    plot_command
        ->add_option_function<std::string>(
            name,
            [&arguments, name](const std::string& value) {
              arguments.plot_options.insert(arguments.plot_options.end(), {name, value});
            },
            text)
        ->type_name(type);
  };
  hand_on("--out", "FILE", "picture to write; NAME.png by default");
  hand_on("--time", "S", "the last frame by default");
  try {
    if (!surge::parse_command_line(app, argc, argv)) return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  arguments.run.terminal = isatty(STDOUT_FILENO) == 1 && !arguments.quiet;
  if (run_command->parsed()) {
    if (arguments.run.threads > 1) surge::wait_passively(argv);
    surge::keep_freed_memory();
    return run(arguments);
  }
  if (check_command->parsed()) check(arguments);
  if (list_command->parsed()) list(arguments);
  if (new_command->parsed()) make_case(arguments);
  if (plot_command->parsed()) plot(arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    surge::report_file_size_limit();
    return run_program(argc, argv);
  } catch (const surge::RestartError& error) {
    surge::print_error("surge-particle", surge::printable(error.what()));
    return exit_no_restart;
  } catch (const std::exception& error) {
    surge::print_error("surge-particle", surge::printable(error.what()));
    return 1;
  }
}
