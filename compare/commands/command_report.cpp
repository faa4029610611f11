#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <span>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/figures/figures.hpp"
#include "compare/report/report.hpp"
#include "compare/report/swap.hpp"
#include "compare/study/run_fault.hpp"
#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

struct ReportInput {
  std::string study;
  std::string runs = "runs";
  std::string out;
  std::string series;
  std::string programs;
  std::string figure;
  bool quiet = false;
};

/// Options that say what is to be shown; the three commands share them.
void add_study_options(CLI::App& command, ReportInput& arguments, const std::string& out) {
  arguments.out = out;
  command.add_option("--study", arguments.study, "study (TOML): runs, reference, snapshot times")
      ->required();
  command.add_option("--runs", arguments.runs, "folder of the runs")->capture_default_str();
  command.add_option("--out", arguments.out, "folder to write to")->capture_default_str();
  command.add_option("--series", arguments.series,
                     "folder of the published series (default: beside the study, ../reference "
                     "beside it, or compare/reference)");
  command.add_option("--programs", arguments.programs,
                     "folder of the programs that check the study's cases (default: this one's)");
}

/// Makes something of a study. A run whose files turn out to be faulty on the way is left out, and
/// all is begun again: what is made holds the fault of one run as one run's.
void make_of_study(const ReportInput& arguments,
                   const std::function<void(const StudyResult&)>& make) {
  const Study study = read_checked_study(arguments.study, arguments.programs, {}, arguments.series);
  Faults faults;
  while (true) {
    try {
      make(collect(study, arguments.runs, arguments.series, faults));
      return;
    } catch (const RunFault& fault) {
      if (!faults.emplace(fault.run(), fault.what()).second) throw;
    }
  }
}

void draw_and_say(std::span<const Figure> figures, const fs::path& folder) {
  const std::vector<std::string> warnings = draw_all(figures, folder);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::string name = figures[i].name;
    if (!figures[i].missing.empty()) {
      std::printf("%s: not drawn: %s\n", name.c_str(), printable_lines(figures[i].missing).c_str());
      continue;
    }
    if (!warnings[i].empty()) {
      std::fprintf(stderr, "surge-compare: %s: %s", name.c_str(),
                   printable_lines(warnings[i]).c_str());
    }
    std::printf("%s\n", (folder / (name + ".svg")).c_str());
  }
}

void run_report(const ReportInput& arguments, const StudyResult& study) {
  std::string warnings, table;
  make_in_place(arguments.out, [&](const fs::path& folder) {
    table = summary_table(study, write_report(study, folder, warnings));
    errno = 0;
    std::ofstream summary(folder / "summary.txt");
    summary << table;
    summary.close();
    if (!summary) throw write_error(folder / "summary.txt");
  });
  if (!warnings.empty())
    std::fprintf(stderr, "surge-compare: %s", printable_lines(warnings).c_str());
  if (arguments.quiet) return;
  std::printf("%s\nreport: %s\n", printable_lines(table).c_str(),
              fs::absolute(fs::path(arguments.out) / "index.html").lexically_normal().c_str());
}

}  // namespace

void add_figures_command(CLI::App& app) {
  auto arguments = std::make_shared<ReportInput>();
  CLI::App* command = app.add_subcommand("figures", "Draws all figures of a study as SVG and PDF");
  add_study_options(*command, *arguments, "report/figures");
  command->callback([arguments] {
    make_of_study(*arguments, [&](const StudyResult& study) {
      draw_and_say(figures_of(study), arguments->out);
    });
  });
}

void add_figure_command(CLI::App& app) {
  auto arguments = std::make_shared<ReportInput>();
  CLI::App* command = app.add_subcommand("figure", "Draws one figure of a study as SVG and PDF");
  command
      ->add_option("NUMBER", arguments->figure,
                   "as in the paper (8), or a name: " + known_figures() +
                       ", or that of any other figure in the report")
      ->required();
  add_study_options(*command, *arguments, "report/figures");
  command->callback([arguments] {
    make_of_study(*arguments, [&](const StudyResult& study) {
      const Figure figure = figure_of(study, arguments->figure);
      if (!figure.missing.empty())
        throw Error("figure " + arguments->figure + ": nothing to draw: " + figure.missing);
      draw_and_say({&figure, 1}, arguments->out);
    });
  });
}

void add_report_command(CLI::App& app) {
  auto arguments = std::make_shared<ReportInput>();
  CLI::App* command =
      app.add_subcommand("report", "Writes index.html, metrics.json and figures of a study");
  add_study_options(*command, *arguments, "report");
  command->add_flag("--quiet", arguments->quiet,
                    "print nothing but warnings; the table is in summary.txt");
  command->footer(
      "Example:\n"
      "  surge-compare report --study compare/studies/dam_break.toml --runs runs --out report");
  command->callback([arguments] {
    make_of_study(*arguments, [&](const StudyResult& study) { run_report(*arguments, study); });
  });
}

}  // namespace surge::compare
