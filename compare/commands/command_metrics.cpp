#include <cstdio>
#include <fstream>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/read/recorded.hpp"
#include "compare/study/metrics.hpp"
#include "particle/support/write_error.hpp"

namespace surge::compare {
namespace {

struct Arguments {
  StudyArguments study;
  SourceArguments files;
  FrontArguments front;
  std::string out;
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

void write_json(const std::filesystem::path& file, const nlohmann::json& value) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  out.flush();
  if (!out) throw write_error(file);
}

void run_metrics(const Arguments& arguments) {
  const std::optional<Study> study = arguments.study.study();
  MetricsOptions options;
  options.front = arguments.front.get(study);
  options.wall_distance = DimensionlessLength(arguments.wall_distance);
  options.allowed_differences.insert(arguments.allow.begin(), arguments.allow.end());
  const std::vector<PublishedSeries> published = arguments.study.published(study);
  const std::vector<std::filesystem::path> sources = arguments.study.runs(study);
  const std::vector<SourceOptions> files = arguments.files.get(sources);
  std::vector<MeasuredRun> runs;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    runs.push_back(measure(open_run(sources[i], files[i]), options.front, true));
    print_notices(runs.back().run);
  }
  const nlohmann::json result = metrics(runs, arguments.study.reference(study), published, options);
  write_json(arguments.out, result);
  for (const MeasuredRun& measured : runs)
    if (is_unfinished(measured.run))
      std::printf("%s: UNFINISHED: %s\n", measured.run.name.c_str(),
                  measured.run.notices[0].c_str());
  print_table(result);
  std::printf("%s\n", arguments.out.c_str());
}

}  // namespace

void add_metrics_command(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("metrics", "Differences of leading edges between runs, as JSON");
  arguments->study.add_to(*command);
  command->add_option("--out", arguments->out, "file to write")->required();
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
      "Examples:\n"
      "  surge-compare metrics --study compare/studies/dam_break.toml --out report/metrics.json\n"
      "  surge-compare metrics runs/mps-paper-0.005 --reference runs/vof-20 --out metrics.json \\\n"
      "    --published compare/reference/martin_moyce_1952_2.25in.csv\n"
      "  surge-compare metrics pysph openmps --reference runs/vof-20 --out metrics.json \\\n"
      "    --spacing pysph=0.0145 --gravity pysph=9.81 --map openmps=openmps.toml");
  command->callback([arguments] { run_metrics(*arguments); });
}

}  // namespace surge::compare
