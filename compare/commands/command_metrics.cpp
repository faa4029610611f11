#include <cstdio>
#include <fstream>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/study/metrics.hpp"
#include "particle/support/error.hpp"

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
  out << value.dump(2) << '\n';
  out.flush();
  if (!out) throw Error(file.string() + ": cannot be written");
}

void run_metrics(const Arguments& arguments) {
  const std::optional<Study> study = arguments.study.study();
  MetricsOptions options;
  options.front = arguments.front.get(study);
  options.wall_distance = DimensionlessLength(arguments.wall_distance);
  options.allowed_differences.insert(arguments.allow.begin(), arguments.allow.end());
  const std::vector<PublishedSeries> published = arguments.study.published(study);
  const SourceOptions files = arguments.files.get();
  SourceOptions own;
  own.alpha_array = files.alpha_array;
  std::vector<MeasuredRun> runs;
  for (const std::filesystem::path& path : arguments.study.runs(study)) {
    // Options about foreign files are for those only; runs with a manifest state their case.
    const bool stated = std::filesystem::exists(path / "manifest.json");
    runs.push_back(measure(open_run(path, stated ? own : files), options.front, true));
    print_notices(runs.back().run);
  }
  const nlohmann::json result = metrics(runs, arguments.study.reference(study), published, options);
  write_json(arguments.out, result);
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
      "    --published compare/reference/martin_moyce_1952_2.25in.csv");
  command->callback([arguments] { run_metrics(*arguments); });
}

}  // namespace surge::compare
