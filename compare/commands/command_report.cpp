#include <cstdio>
#include <memory>

#include "compare/commands/commands.hpp"
#include "compare/figures/figures.hpp"
#include "compare/report/report.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

struct Arguments {
  std::string study;
  std::string runs = "runs";
  std::string out;
  std::string series;
  std::string figure;
};

/// Options that say what is to be shown; the three commands share them.
void add_study_options(CLI::App& command, Arguments& arguments, const std::string& out) {
  arguments.out = out;
  command.add_option("--study", arguments.study, "study (TOML): runs, reference, snapshot times")
      ->required();
  command.add_option("--runs", arguments.runs, "folder of the runs")->capture_default_str();
  command.add_option("--out", arguments.out, "folder to write to")->capture_default_str();
  command.add_option("--series", arguments.series,
                     "folder of the published series (default: ../reference beside the study)");
}

StudyResult collect_study(const Arguments& arguments) {
  const fs::path file = arguments.study;
  const fs::path beside = (file.parent_path() / ".." / "reference").lexically_normal();
  return collect(read_study(file), arguments.runs,
                 arguments.series.empty() ? beside : fs::path(arguments.series));
}

void draw_and_say(const Figure& figure, const fs::path& folder) {
  const std::string warnings = draw(figure, folder);
  if (!warnings.empty()) {
    std::fprintf(stderr, "surge-compare: %s: %s", figure.name.c_str(), warnings.c_str());
  }
  std::printf("%s\n", (folder / (figure.name + ".svg")).c_str());
}

void run_report(const Arguments& arguments) {
  const StudyResult study = collect_study(arguments);
  std::string warnings;
  const nlohmann::json metrics = write_report(study, arguments.out, warnings);
  if (!warnings.empty()) std::fprintf(stderr, "surge-compare: %s", warnings.c_str());
  std::printf("%s\nreport: %s\n", summary_table(study, metrics).c_str(),
              fs::absolute(fs::path(arguments.out) / "index.html").lexically_normal().c_str());
}

}  // namespace

void add_figures_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("figures", "Draws all figures of a study as SVG and PDF");
  add_study_options(*command, *arguments, "report/figures");
  command->callback([arguments] {
    const StudyResult study = collect_study(*arguments);
    for (const Figure& figure : figures_of(study)) draw_and_say(figure, arguments->out);
  });
}

void add_figure_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("figure", "Draws one figure of a study as SVG and PDF");
  command
      ->add_option("NUMBER", arguments->figure,
                   "as in the paper (8), or a name: " + known_figures() +
                       ", or that of any other figure in the report")
      ->required();
  add_study_options(*command, *arguments, "report/figures");
  command->callback([arguments] {
    draw_and_say(figure_of(collect_study(*arguments), arguments->figure), arguments->out);
  });
}

void add_report_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("report", "Writes index.html, metrics.json and figures of a study");
  add_study_options(*command, *arguments, "report");
  command->footer(
      "Example:\n"
      "  surge-compare report --study compare/studies/dam_break.toml --runs runs --out report");
  command->callback([arguments] { run_report(*arguments); });
}

}  // namespace surge::compare
