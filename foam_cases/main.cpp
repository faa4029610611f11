#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "foam_cases/foam_case.hpp"
#include "foam_cases/size.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/command_line.hpp"
#include "particle/support/error.hpp"
#include "particle/support/file_size_limit.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/version.hpp"

namespace {

struct Arguments {
  std::string case_file;
  std::string folder;
  std::vector<std::string> overrides;
  std::vector<std::string> settings;
  bool force = false;
  bool json = false;
  bool quiet = false;
};

void describe(const surge::foam::FoamCase& c) {
  const surge::foam::CaseSize size = surge::foam::case_size(c);
  const auto text = [](double value) { return surge::number_text(value); };
  std::cout << surge::printable(c.flow.title) << "\n  dimension   " << c.flow.dimension
            << "\n  solver      " << c.settings.solver << "\n  mesh        " << text(size.cells)
            << " cells of " << surge::foam::short_text(c.mesh.cell) << " m, "
            << c.settings.cells_per_length << " to L = " << text(c.mesh.length)
            << " m\n  end         " << text(c.flow.time.end) << " s, " << text(size.frames)
            << " frames, one every " << text(c.flow.output_interval) << " s\n  steps       about "
            << text(size.steps) << "\n  memory      about " << surge::foam::bytes_text(size.memory)
            << "\n  disk        about " << surge::foam::bytes_text(size.disk) << '\n';
  for (const std::string& note : surge::foam::notes_on(c)) std::cout << "note: " << note << '\n';
}

void check(const Arguments& arguments) {
  const auto made =
      surge::foam::read_foam_case(arguments.case_file, arguments.overrides, arguments.settings);
  if (!arguments.json) return describe(made);
  const nlohmann::json told{{"size", to_json(surge::foam::case_size(made))}};
  std::cout << told.dump(2) << '\n';
}

void make(const Arguments& arguments) {
  const auto made =
      surge::foam::read_foam_case(arguments.case_file, arguments.overrides, arguments.settings);
  surge::foam::check_disk(surge::foam::case_size(made), arguments.folder);
  surge::foam::write_case(surge::foam::case_files(made), arguments.folder, arguments.force);
  if (arguments.quiet) return;
  describe(made);
  std::cout << "written to " << surge::printable(arguments.folder) << "; run its Allrun\n";
}

void list() {
  std::string group;
  for (const surge::foam::SettingText& setting : surge::foam::setting_texts({})) {
    if (setting.group != group) std::cout << setting.group << '\n';
    group = setting.group;
    std::cout << "  " << setting.key << " = " << setting.value << "   # " << setting.comment
              << '\n';
  }
  std::cout
      << "cells_per_length and length are other names of cellsPerL and L; deltaT and maxDeltaT\n"
         "of 0 are the case's time.initial_step and time.maximum_step\n";
}

std::string version_text() {
  const surge::BuildInfo build = surge::build_info();
  return "surge-foam " + build.version + " (commit " + build.commit + ", " + build.compiler + ", " +
         build.flags + ")";
}

int run_program(int argc, char** argv) {
  CLI::App app{"Makes OpenFOAM cases (interFoam) from case files", "surge-foam"};
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
    command
        ->add_option("--foam", arguments.settings,
                     "choose a setting (surge-foam list shows all); may be repeated")
        ->type_name("key=value")
        ->allow_extra_args(false);
  };
  CLI::App* make_command = app.add_subcommand("make", "write the OpenFOAM case of a case file");
  with_case(make_command);
  make_command->add_option("--out", arguments.folder, "folder of the OpenFOAM case")
      ->required()
      ->type_name("DIR");
  make_command->add_flag("--force", arguments.force, "write over the case that the folder holds");
  make_command->add_flag("--quiet", arguments.quiet, "print errors and nothing else");
  CLI::App* check_command =
      app.add_subcommand("check", "read and check a case file, and say what the mesh will be");
  with_case(check_command);
  check_command->add_flag("--json", arguments.json, "print what the case will take as JSON");
  CLI::App* list_command = app.add_subcommand("list", "list the settings with their defaults");
  try {
    if (!surge::parse_command_line(app, argc, argv)) return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  if (make_command->parsed()) make(arguments);
  if (check_command->parsed()) check(arguments);
  if (list_command->parsed()) list();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    surge::report_file_size_limit();
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    surge::print_error("surge-foam", surge::printable(error.what()));
    return 1;
  }
}
