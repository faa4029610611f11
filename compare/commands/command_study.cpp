#include <cstdio>
#include <fstream>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/study/study_check.hpp"
#include "compare/study/study_json.hpp"
#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {

namespace {

struct StudyInput {
  std::string study;
  std::string json;
  std::string only;
  std::string programs;
};

void print_study(const nlohmann::json& study) {
  std::printf("%s\nreference: %s\n", printable(study["title"].get<std::string>()).c_str(),
              study["reference"].get<std::string>().c_str());
  for (const nlohmann::json& run : study["runs"]) {
    std::string roles;
    for (const nlohmann::json& role : run["roles"]) {
      roles += (roles.empty() ? "" : "; ") + role["role"].get<std::string>();
      if (const auto group = role["group"].get<std::string>(); !group.empty())
        roles += " (" + group + ")";
    }
    std::printf("  %-36s %s, %s\n", run["name"].get<std::string>().c_str(),
                run["program"].get<std::string>().c_str(), printable(roles).c_str());
  }
  for (const nlohmann::json& notice : study["notices"])
    std::printf("notice: %s\n", printable(notice.get<std::string>()).c_str());
}

void write_plan(const std::string& where, const nlohmann::json& value) {
  const std::string text = value.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (where == "-") {
    std::printf("%s\n", text.c_str());
    return;
  }
  std::ofstream out(where);
  out << text << '\n';
  out.close();
  if (!out) throw write_error(where);
}

void run_study(const StudyInput& arguments) {
  Study study = read_checked_study(arguments.study, arguments.programs, arguments.only);
  const nlohmann::json out = to_json(study, arguments.only);
  if (!arguments.only.empty() && out["runs"].empty())
    throw Error(arguments.study + ": found no run " + arguments.only + ", expected one (--only)");
  if (arguments.json.empty()) {
    print_study(out);
  } else {
    write_plan(arguments.json, out);
  }
}

}  // namespace

Study read_checked_study(const std::filesystem::path& file, const std::string& programs,
                         const std::string& only, const std::filesystem::path& series) {
  Study study = read_study(file);
  for (StudyRun& run : study.runs)
    if (run.is_files()) run.source = source_options(run);
  check_study(study, programs.empty() ? own_folder() : std::filesystem::path(programs), only,
              series);
  return study;
}

void add_study_command(CLI::App& app) {
  auto arguments = std::make_shared<StudyInput>();
  CLI::App* command = app.add_subcommand(
      "study", "Reads a study, checks all that it names, and prints what it asks for");
  command->add_option("FILE", arguments->study, "study (TOML)")->required();
  command
      ->add_option("--json", arguments->json,
                   "write all of it as JSON to a file, or with - to the standard output")
      ->expected(0, 1)
      ->default_str("-");
  command->add_option("--only", arguments->only, "this run alone");
  command->add_option("--programs", arguments->programs,
                      "folder of surge-particle and surge-foam (default: that of surge-compare)");
  command->footer("Example:\n  surge-compare study compare/studies/dam_break.toml");
  command->callback([arguments] { run_study(*arguments); });
}

}  // namespace surge::compare
