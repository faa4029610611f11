#include <cstdio>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/commands/output.hpp"
#include "compare/commands/tolerances.hpp"
#include "compare/read/recorded.hpp"
#include "compare/study/limits.hpp"
#include "compare/study/metrics.hpp"
#include "particle/support/printable.hpp"

namespace surge::compare {
namespace {

struct MetricsInput {
  StudyArguments study;
  SourceArguments files;
  FrontArguments front;
  std::string out;
  std::string junit;
  std::vector<std::string> max_rms, max_difference, max_bias, max_arrival;
  double wall_distance = 0.1;
  std::vector<std::string> allow;
};

std::string number_or_dash(const nlohmann::json& value) {
  if (!value.is_number()) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", value.get<double>());
  return text;
}

void print_table(const nlohmann::json& metrics) {
  std::printf("%-28s %8s %8s %8s %10s   Z/L against %s\n", "run", "RMS", "max", "bias", "impact/s",
              metrics["definition"]["reference"].get<std::string>().c_str());
  for (const auto& [name, front] : metrics["front"].items()) {
    const std::string against = front.contains("rms_vs_vof") ? "vof" : "reference";
    std::printf("%-28s %8s %8s %8s %10s\n", name.c_str(),
                number_or_dash(front["rms_vs_" + against]).c_str(),
                number_or_dash(front["max_vs_" + against]).c_str(),
                number_or_dash(front["bias_vs_" + against]).c_str(),
                number_or_dash(front["impact_time_s"]).c_str());
  }
}

void write_json(const std::string& file, const nlohmann::json& value) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (file != "-" && !folder.empty()) std::filesystem::create_directories(folder);
  write_to(file, [&](std::ostream& out) { out << dump(value) << '\n'; });
}

/// Exit code of what the limits make of the metrics.
int judge(const nlohmann::json& metrics, const MetricsInput& arguments) {
  const Limits limits{read_tolerances("--max-rms", arguments.max_rms),
                      read_tolerances("--max-difference", arguments.max_difference),
                      read_tolerances("--max-bias", arguments.max_bias),
                      read_tolerances("--max-arrival", arguments.max_arrival)};
  if (!limits.any()) {
    if (!arguments.junit.empty())
      throw Error("--junit-xml: found no limit (--max-rms and the like), expected one");
    return exit_success;
  }
  const std::vector<CheckReport> reports = check_limits(metrics, limits);
  if (!arguments.junit.empty())
    write_to(arguments.junit, [&](std::ostream& out) { write_junit(out, reports); });
  bool passed = true;
  for (const CheckReport& report : reports) {
    passed = passed && report.passed();
    write_table(arguments.out == "-" || arguments.junit == "-" ? std::cerr : std::cout, report);
  }
  return passed ? exit_success : exit_check_failed;
}

int run_metrics(const MetricsInput& arguments) {
  const std::optional<Study> study = arguments.study.study();
  MetricsOptions options;
  options.front = arguments.front.get(study);
  options.wall_distance = DimensionlessLength(arguments.wall_distance);
  options.allowed_differences.insert(arguments.allow.begin(), arguments.allow.end());
  const std::vector<PublishedSeries> published = arguments.study.published(study);
  const std::vector<std::filesystem::path> sources = arguments.study.runs(study);
  const std::vector<SourceOptions> files = arguments.files.get(sources);
  const std::vector<std::string> names = run_names(sources);
  std::vector<MeasuredRun> runs;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Run run = open_run(sources[i], files[i]);
    if (!study) run.name = names[i];
    runs.push_back(measure(std::move(run), options.front, true));
    print_notices(runs.back().run);
  }
  const nlohmann::json result = metrics(runs, arguments.study.reference(study), published, options);
  write_json(arguments.out, result);
  if (arguments.out == "-") return judge(result, arguments);
  for (const MeasuredRun& measured : runs)
    if (is_unfinished(measured.run))
      std::printf("%s: UNFINISHED: %s\n", measured.run.name.c_str(),
                  printable(measured.run.notices[0]).c_str());
  print_table(result);
  std::printf("%s\n", arguments.out.c_str());
  std::fflush(stdout);
  return judge(result, arguments);
}

}  // namespace

void add_metrics_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<MetricsInput>();
  CLI::App* command =
      app.add_subcommand("metrics", "Differences of leading edges between runs, as JSON");
  arguments->study.add_to(*command);
  command->add_option("--out", arguments->out, "file to write (JSON); - for standard output")
      ->required();
  const auto limit = [&](const char* name, std::vector<std::string>& values, const char* help) {
    command->add_option(name, values, help)
        ->group("Limits (VALUE for all runs, RUN=VALUE for one of them)")
        ->take_all()
        ->allow_extra_args(false)
        ->type_name("VALUE");
  };
  limit("--max-rms", arguments->max_rms, "of the RMS difference of Z/L to the reference");
  limit("--max-difference", arguments->max_difference, "of the largest difference of Z/L");
  limit("--max-bias", arguments->max_bias, "of the mean difference of Z/L");
  limit("--max-arrival", arguments->max_arrival, "of the difference of arrivals, in T");
  command->add_option("--junit-xml", arguments->junit,
                      "file to write for a CI service; - for standard output");
  command
      ->add_option("--wall-distance", arguments->wall_distance,
                   "the comparison ends when either front is this near to the far wall, in L")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--allow", arguments->allow,
                      "accept a named difference of physics (see the error's key)");
  arguments->front.add_to(*command);
  arguments->files.add_to(*command);
  command->footer(
      "Exit code: 0; 2 where a limit is exceeded; 1 where nothing could be compared.\nExamples:\n"
      "  surge-compare metrics --study compare/studies/dam_break.toml --out report/metrics.json\n"
      "  surge-compare metrics runs/mps-paper-0.005 --reference runs/vof-20 --out metrics.json \\\n"
      "    --published compare/reference/martin_moyce_1952_2.25in.csv\n"
      "  surge-compare metrics pysph openmps --reference runs/vof-20 --out metrics.json \\\n"
      "    --spacing pysph=0.0145 --gravity pysph=9.81 --map openmps=openmps.toml\n"
      "  surge-compare metrics out --reference vof --out - --max-rms 0.08 --junit-xml check.xml");
  command->callback([arguments, &exit_code] { exit_code = run_metrics(*arguments); });
}

}  // namespace surge::compare
