#include "compare/movie/command_movie.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "compare/commands/command_options.hpp"
#include "compare/movie/movie.hpp"
#include "compare/report/viewer.hpp"
#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

struct MovieInput {
  std::string source, out, field = "pressure", runs = "runs", series, programs;
  std::vector<std::string> show;
  double speed = 0.0, end = 0.0;
  int pictures = 25, width = 1280;
  SourceArguments files;
};

MovieOptions options_of(const MovieInput& arguments) {
  MovieOptions options;
  options.out = arguments.out;
  options.speed_of_water = arguments.field == "speed";
  if (arguments.speed > 0.0) options.pace = arguments.speed;
  if (arguments.end > 0.0) options.end = Seconds(arguments.end);
  options.pictures = arguments.pictures;
  options.width = arguments.width;
  return options;
}

void say(const std::vector<std::string>& notices) {
  for (const std::string& line : notices)
    std::fprintf(stderr, "surge-compare: %s\n", printable_lines(line).c_str());
}

/// The reference and the runs of that name, in the order in which they were named; without names
/// those of the page's viewer. The first one's surface is drawn over all.
std::vector<const RunResult*> shown_runs(const StudyResult& study,
                                         const std::vector<std::string>& names) {
  const RunResult* reference = &study.reference();
  std::vector<const RunResult*> all{reference};
  if (names.empty()) {
    for (const RunResult* run : plan_viewer(study).runs)
      if (run != reference) all.push_back(run);
    return all;
  }
  std::string known;
  for (const RunResult* run : study.measured())
    known += (known.empty() ? "" : ", ") + run->study.name;
  const std::vector<const RunResult*> measured = study.measured();
  for (const std::string& name : names) {
    const auto found = std::find_if(measured.begin(), measured.end(),
                                    [&](const RunResult* run) { return run->study.name == name; });
    if (found == measured.end())
      throw Error("--show: found \"" + name + "\", expected names out of " + known);
    if (std::find(all.begin(), all.end(), *found) == all.end()) all.push_back(*found);
  }
  return all;
}

std::size_t movie_of_study(const MovieInput& arguments, MovieOptions options) {
  const Study study =
      read_checked_study(arguments.source, arguments.programs, {}, arguments.series);
  const StudyResult result = collect(study, arguments.runs, arguments.series);
  if (!result.has_reference())
    throw Error(arguments.source + ": found a study without a reference run, expected one");
  options.title = result.study.title;
  std::vector<MoviePanel> panels;
  for (const RunResult* run : shown_runs(result, arguments.show))
    panels.push_back({&run->measured->run, run->label()});
  return write_movie(panels, options);
}

std::size_t movie_of_run(const MovieInput& arguments, MovieOptions options) {
  if (!arguments.show.empty())
    throw Error("--show: found one run, expected a study, whose runs it chooses");
  const Run run = open_run(arguments.source, arguments.files.get(arguments.source));
  options.title = run.name;
  const std::size_t pictures = write_movie(std::vector<MoviePanel>{{&run, ""}}, options);
  say(run.notices);
  say(run.frames->notices());
  return pictures;
}

}  // namespace

void add_movie_command(CLI::App& app) {
  auto arguments = std::make_shared<MovieInput>();
  CLI::App* command =
      app.add_subcommand("movie", "Writes a film of a run, or of a study's runs side by side");
  command->add_option("SOURCE", arguments->source, "run, files of another program, or study (TOML)")
      ->required();
  command->add_option("--out", arguments->out, "file to write, .mp4 or .gif (with ffmpeg)")
      ->required();
  command->add_option("--runs", arguments->runs, "of a study: folder of the runs")
      ->capture_default_str();
  command->add_option("--series", arguments->series, "of a study: folder of the published series");
  command->add_option("--programs", arguments->programs,
                      "of a study: folder of the programs that check its cases");
  command
      ->add_option("--show", arguments->show,
                   "of a study: runs beside the reference (default: those of the page)")
      ->delimiter(',')
      ->type_name("RUN,...");
  command->add_option("--field", arguments->field, "colour of the water")
      ->check(CLI::IsMember({"pressure", "speed"}))
      ->capture_default_str();
  command
      ->add_option("--speed", arguments->speed,
                   "simulated seconds per second (default: the film takes 8 s)")
      ->check(CLI::PositiveNumber);
  command->add_option("--end", arguments->end, "time of the flow at which it ends, s")
      ->check(CLI::PositiveNumber);
  command->add_option("--pictures", arguments->pictures, "per second")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  command->add_option("--width", arguments->width, "pixels")
      ->check(CLI::Range(240, 3840))
      ->capture_default_str();
  arguments->files.add_to(*command);
  command->footer(
      "Example:\n"
      "  surge-compare movie compare/studies/dam_break.toml --out dam_break.mp4");
  command->callback([arguments] {
    const bool is_study = fs::path(arguments->source).extension() == ".toml";
    const MovieOptions options = options_of(*arguments);
    const std::size_t pictures =
        is_study ? movie_of_study(*arguments, options) : movie_of_run(*arguments, options);
    std::printf("%s: %zu pictures, %d a second\n", printable_lines(arguments->out).c_str(),
                pictures, options.pictures);
  });
}

}  // namespace surge::compare
