#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/commands/output.hpp"
#include "compare/measure/measure_all.hpp"
#include "compare/measure/measured_text.hpp"
#include "compare/measure/registry.hpp"
#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"

namespace surge::compare {
namespace {

struct MeasureInput {
  std::vector<std::string> sources;
  std::vector<std::string> observables;
  std::string reference;
  std::string csv, json;
  bool list = false;
  SourceArguments files;
  FrontArguments front;
};

/// The sources and the reference, each with what was said about its files.
class Files {
 public:
  explicit Files(const MeasureInput& arguments) {
    for (const std::string& source : arguments.sources) add(source);
    if (!arguments.reference.empty()) add(arguments.reference);
    options_ = arguments.files.get(paths_);
  }
  [[nodiscard]] Run open(const std::filesystem::path& path) const {
    const auto place = std::find(paths_.begin(), paths_.end(), path) - paths_.begin();
    Run run = open_run(path, options_[static_cast<std::size_t>(place)]);
    run.name = run_names(paths_)[static_cast<std::size_t>(place)];
    return run;
  }

 private:
  /// One that is named twice is one source.
  void add(const std::filesystem::path& path) {
    if (std::find(paths_.begin(), paths_.end(), path) == paths_.end()) paths_.push_back(path);
  }

  std::vector<std::filesystem::path> paths_;
  std::vector<SourceOptions> options_;
};

void list_observables() {
  for (const ObservableKind& kind : observable_kinds()) {
    std::printf("%-18s %s\n", std::string(kind.name).c_str(), std::string(kind.measures).c_str());
    if (!kind.parameters.empty())
      std::printf("%-18s   %s\n", "", std::string(kind.parameters).c_str());
  }
}

MeasuredSource measure_source(Run run, const MeasureInput& arguments, const Run* reference) {
  const ObservableContext context{run, arguments.front.get(std::nullopt), reference};
  std::vector<std::unique_ptr<Observable>> observables;
  for (const std::string& request : arguments.observables)
    observables.push_back(make_observable(request, context));
  MeasuredSource measured{run.name, run.path.string(), arguments.observables, {}, {}};
  measured.findings = measure_all(run, observables);
  measured.notices = run.notices;
  print_notices(run);
  for (const Findings& found : measured.findings)
    for (const std::string& notice : found.notices)
      std::fprintf(stderr, "%s: notice: %s\n", run.name.c_str(), printable(notice).c_str());
  return measured;
}

int run_measure(const MeasureInput& arguments) {
  if (arguments.list) {
    list_observables();
    return exit_success;
  }
  if (arguments.sources.empty() || arguments.observables.empty())
    throw Error(
        "measure: found no SOURCE or no --observable, expected one or more of both "
        "(--list names the observables)");
  const Files files(arguments);
  std::optional<Run> reference;
  if (!arguments.reference.empty()) reference = files.open(arguments.reference);
  std::vector<MeasuredSource> measured;
  int exit_code = exit_success;
  for (const std::string& source : arguments.sources) {
    measured.push_back(
        measure_source(files.open(source), arguments, reference ? &*reference : nullptr));
    for (std::size_t k = 0; k < measured.back().findings.size(); ++k) {
      const auto& failure = measured.back().findings[k].failure;
      if (!failure) continue;
      exit_code = exit_error;
      std::fprintf(stderr, "surge-compare: %s: %s: %s\n", measured.back().name.c_str(),
                   arguments.observables[k].c_str(), printable(*failure).c_str());
    }
  }
  if (!arguments.csv.empty())
    write_to(arguments.csv, [&](std::ostream& out) { write_csv(out, measured); });
  if (!arguments.json.empty())
    write_to(arguments.json, [&](std::ostream& out) { out << to_json(measured).dump(2) << '\n'; });
  if (arguments.csv != "-" && arguments.json != "-")
    for (const MeasuredSource& source : measured) write_table(std::cout, source);
  return exit_code;
}

}  // namespace

void add_measure_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<MeasureInput>();
  CLI::App* command = app.add_subcommand(
      "measure", "Any observables of one source or more over time, as a table, CSV or JSON");
  command->add_option("SOURCE", arguments->sources,
                      "run folders, OpenFOAM cases, .pvd, folders or patterns of particle files");
  command
      ->add_option("--observable", arguments->observables,
                   "what to measure: KIND or KIND:key=value,key=value; again for each")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--list", arguments->list, "list the observables with their parameters");
  command->add_option("--reference", arguments->reference, "run that the water is compared with");
  auto* csv = command->add_option("--csv", arguments->csv, "file to write; - for standard output");
  command->add_option("--json", arguments->json, "file to write; - for standard output")
      ->check([csv, arguments](const std::string& value) {
        (void)csv;
        return value == "-" && arguments->csv == "-" ? "only one of --csv and --json can be -" : "";
      });
  arguments->front.add_to(*command);
  arguments->files.add_to(*command);
  command->footer(
      "A run's frames are read once. Places and lengths are in m, in the source's coordinates.\n"
      "Exit code: 0, or 1 where one of the observables could not be measured.\nExamples:\n"
      "  surge-compare measure --list\n"
      "  surge-compare measure runs/mine --observable gauge:x=0.3 --observable front --csv -\n"
      "  surge-compare measure runs/mine runs/vof-20 --observable \"profile:times=0.1;0.2\" "
      "--json profiles.json");
  command->callback([arguments, &exit_code] { exit_code = run_measure(*arguments); });
}

}  // namespace surge::compare
