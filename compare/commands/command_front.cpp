#include <cmath>
#include <cstdio>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/commands/commands.hpp"
#include "compare/commands/output.hpp"
#include "compare/measure/front.hpp"
#include "compare/read/recorded.hpp"
#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"

namespace surge::compare {
namespace {

struct FrontInput {
  std::string source;
  std::string out, json;
  std::string study;
  SourceArguments files;
  FrontArguments front;
};

/// {"name", "path", "column_width_m", "time_s": [], "T": [], "Z_over_L": [], "notices": []}
nlohmann::json to_json(const Run& run, const FrontHistory& history) {
  const Scales scales = run.physics.scales();
  nlohmann::json out{{"name", run.name},
                     {"path", run.path.string()},
                     {"column_width_m", run.physics.column_width().value()},
                     {"time_s", nlohmann::json::array()},
                     {"T", nlohmann::json::array()},
                     {"Z_over_L", nlohmann::json::array()},
                     {"notices", run.notices}};
  for (const FrontSample& sample : history) {
    out["time_s"].push_back(sample.time.value());
    out["T"].push_back(scales.dimensionless(sample.time).value());
    out["Z_over_L"].push_back(scales.dimensionless(sample.position).value());
  }
  return out;
}

void write_files(const FrontInput& arguments, const Run& run, const FrontHistory& history) {
  if (!arguments.json.empty())
    write_to(arguments.json,
             [&](std::ostream& out) { out << dump(to_json(run, history)) << '\n'; });
  if (arguments.out == "-") {
    write_to("-", [&](std::ostream& out) { write_front_csv(out, history, run.physics.scales()); });
  } else if (!arguments.out.empty()) {
    write_front_csv(std::filesystem::path(arguments.out), history, run.physics.scales());
  }
}

void run_front(const FrontInput& arguments) {
  if (arguments.out.empty() && arguments.json.empty())
    throw Error("front: found neither --out nor --json, expected one of them");
  if (arguments.out == "-" && arguments.json == "-")
    throw Error("front: found - for --out and for --json, expected one of them");
  std::optional<Study> study;
  if (!arguments.study.empty()) study = read_study(arguments.study);
  const FrontOptions options = arguments.front.get(study);
  Run run =
      open_run(arguments.source, arguments.files.get(std::filesystem::path(arguments.source)));
  const FrontHistory history = measure_front(run, options);
  write_files(arguments, run, history);
  if (arguments.out == "-" || arguments.json == "-") {
    print_notices(run);
    return;
  }
  if (is_unfinished(run))
    std::printf("%s: UNFINISHED: %s\n", run.name.c_str(), printable(run.notices[0]).c_str());
  print_notices(run);
  const std::size_t frames = run.frames->times().size();
  const FrontStrip strip = front_strip(run.physics, run.spacing, !run.is_mesh(), options);
  const bool bed = std::isinf(strip.upper);
  std::printf("%s: %zu frames, L = %g m, %s %g m: %s\n", run.name.c_str(), history.size(),
              run.physics.column_width().value(),
              options.raw_maximum ? "raw, strip"
              : bed               ? "wet bed, above"
                                  : "strip",
              options.raw_maximum ? options.strip_height.value()
                                  : (bed ? strip.lower : strip.upper) - run.physics.floor(),
              arguments.out.empty() ? arguments.json.c_str() : arguments.out.c_str());
  if (history.size() < frames) {
    std::printf("%s: no leading edge from %g s on (%zu frames left out)\n", run.name.c_str(),
                run.frames->times()[history.size()].value(), frames - history.size());
  }
}

}  // namespace

void add_front_command(CLI::App& app) {
  auto arguments = std::make_shared<FrontInput>();
  CLI::App* command = app.add_subcommand("front", "Leading edge of one source over time, as CSV");
  command
      ->add_option("SOURCE", arguments->source,
                   "run folder, OpenFOAM case, .pvd, folder or \"pattern_*.vtk\" of particle files")
      ->required();
  command->add_option("--out", arguments->out,
                      "file to write: time_s,T,Z_over_L; - for standard output");
  command->add_option("--json", arguments->json,
                      "file to write with the same as JSON; - for standard output");
  command->add_option("--study", arguments->study, "study (TOML) that states the strip's height");
  arguments->front.add_to(*command);
  arguments->files.add_to(*command);
  command->footer(
      "Examples:\n"
      "  surge-compare front runs/mps-paper-0.005 --out mps.csv\n"
      "  surge-compare front foam_cases/damBreak2D --out vof.csv --strip-height 0.015\n"
      "  surge-compare front 'out/fluid_*.vtk' --out dsph.csv --spacing 0.005 --gravity 9.81 "
      "--time-step 0.01\n"
      "  surge-compare front results --out mine.csv --map mine.toml");
  command->callback([arguments] { run_front(*arguments); });
}

}  // namespace surge::compare
