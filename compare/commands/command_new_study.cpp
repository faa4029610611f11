#include <cstdio>
#include <memory>

#include "compare/commands/commands.hpp"
#include "compare/study/new_study.hpp"
#include "particle/support/new_file.hpp"
#include "particle/support/printable.hpp"

namespace surge::compare {
namespace {

struct NewStudyInput {
  std::string file;
  std::string case_file = "particle/cases/dam_break.toml";
};

void write_study(const NewStudyInput& arguments) {
  const std::filesystem::path folder =
      arguments.file == "-" ? "" : std::filesystem::path(arguments.file).parent_path();
  write_new_file(arguments.file, new_study_text(arguments.case_file, folder));
  if (arguments.file == "-") return;
  const std::string name = printable(arguments.file);
  std::printf("written to %s; next: surge-compare study %s, ./Allrun --study %s\n", name.c_str(),
              name.c_str(), name.c_str());
}

}  // namespace

void add_new_study_command(CLI::App& app) {
  auto arguments = std::make_shared<NewStudyInput>();
  CLI::App* command =
      app.add_subcommand("new-study", "Writes a commented study to start from, of a case file");
  command->add_option("FILE", arguments->file, "study to write; - for standard output")->required();
  command->add_option("--case", arguments->case_file, "case file (TOML) of its runs")
      ->capture_default_str();
  command->footer(
      "Example:\n"
      "  surge-particle new mine.toml && surge-compare new-study study.toml --case mine.toml");
  command->callback([arguments] { write_study(*arguments); });
}

}  // namespace surge::compare
