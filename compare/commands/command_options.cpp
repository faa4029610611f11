#include "compare/commands/command_options.hpp"

#include <cmath>
#include <cstdio>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

template <class Kind>
std::optional<Kind> positive(const char* option, std::optional<double> value) {
  if (!value) return std::nullopt;
  if (!std::isfinite(*value) || *value <= 0.0) {
    throw Error(std::string(option) + ": " + std::to_string(*value) +
                " found, a positive number expected");
  }
  return Kind(*value);
}

}  // namespace

void SourceArguments::add_to(CLI::App& app) {
  const std::string group = "What the files do not say";
  app.add_option("--column-width", column_width_, "L, width of the column at time 0, m")
      ->group(group);
  app.add_option("--column-height", column_height_, "height of the column at time 0, m")
      ->group(group);
  app.add_option("--bed-depth", bed_depth_, "depth of the water that lies in the tank at time 0, m")
      ->group(group);
  app.add_option("--density", options_.density, "of the water, kg/m3")->group(group);
  app.add_option("--tank-width", tank_width_, "far wall from the column's wall, m")->group(group);
  app.add_option("--gravity", options_.gravity, "magnitude, m/s2")->group(group);
  app.add_option("--vertical", vertical_, "axis that gravity points down along")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str()
      ->group(group);
  app.add_option("--dimension", options_.dimension, "2 or 3")
      ->check(CLI::Range(2, 3))
      ->group(group);
  app.add_option("--spacing", spacing_, "particle spacing l0, m")->group(group);
  app.add_option("--time-step", time_step_, "s between files; goes before the times in the files")
      ->group(group);
  const std::string names = "Names of arrays in foreign files";
  app.add_option("--velocity-array", options_.velocity_array)->capture_default_str()->group(names);
  app.add_option("--pressure-array", options_.pressure_array)->capture_default_str()->group(names);
  app.add_option("--type-array", type_array_,
                 "array that tells fluid from walls [type, if there is one]")
      ->group(names);
  app.add_option("--fluid-type", options_.fluid_type, "its value for fluid")
      ->capture_default_str()
      ->group(names);
  app.add_option("--alpha-array", options_.alpha_array,
                 "volume fraction of water in an OpenFOAM case")
      ->capture_default_str()
      ->group(names);
}

SourceOptions SourceArguments::get() const {
  SourceOptions options = options_;
  options.column_width = positive<Metres>("--column-width", column_width_);
  options.column_height = positive<Metres>("--column-height", column_height_);
  options.tank_width = positive<Metres>("--tank-width", tank_width_);
  options.bed_depth = positive<Metres>("--bed-depth", bed_depth_);
  options.density = positive<double>("--density", options_.density);
  options.gravity = positive<double>("--gravity", options_.gravity);
  options.spacing = positive<Metres>("--spacing", spacing_);
  options.time_step = positive<Seconds>("--time-step", time_step_);
  options.vertical_axis = vertical_ == "z" ? 2 : 1;
  options.type_required = type_array_.has_value();
  if (type_array_) options.type_array = *type_array_;
  return options;
}

void FrontArguments::add_to(CLI::App& app) {
  const std::string group = "Leading edge";
  app.add_option("--strip-height", strip_height_,
                 "only water up to this height above the floor counts, m [0.015]; particles: three "
                 "spacings where that is more")
      ->group(group);
  app.add_option("--linking-length", options_.linking_length,
                 "particles closer than this many spacings are connected")
      ->capture_default_str()
      ->group(group);
  app.add_option(
         "--bed-share", options_.bed_share,
         "over water that lies in the tank: the front is where the water stands higher than "
         "it by this share of the column above it")
      ->check(CLI::Range(0.001, 0.999))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--raw-maximum", options_.raw_maximum, "farthest water of all, drops included")
      ->group(group);
}

FrontOptions FrontArguments::get(const std::optional<Study>& study) const {
  FrontOptions options = options_;
  (void)positive<double>("--linking-length", options.linking_length);
  if (study) {
    if (strip_height_) throw Error("--strip-height: given together with --study, which states it");
    options.strip_height = study->strip_height;
  } else if (strip_height_) {
    options.strip_height = *positive<Metres>("--strip-height", strip_height_);
  }
  return options;
}

void StudyArguments::add_to(CLI::App& app) {
  auto* runs = app.add_option("RUN", runs_, "run folders, OpenFOAM cases or particle files");
  app.add_option("--reference", reference_,
                 "run that the others are measured against (one more RUN)")
      ->excludes(app.add_option("--study", study_,
                                "study (TOML) that names runs, reference, strip and series")
                     ->excludes(runs));
  app.add_option("--runs", folder_, "folder of the study's runs")->capture_default_str();
  app.add_option("--published", published_, "published series (CSV) to compare with");
}

std::optional<Study> StudyArguments::study() const {
  if (!study_.empty()) return read_study(study_);
  if (runs_.empty() || reference_.empty())
    throw Error("RUN... with --reference REF, or --study FILE expected");
  return std::nullopt;
}

std::vector<fs::path> StudyArguments::runs(const std::optional<Study>& study) const {
  std::vector<fs::path> paths;
  if (study) {
    for (const StudyRun& run : study->runs) paths.push_back(fs::path(folder_) / run.name);
    return paths;
  }
  bool has_reference = false;
  for (const std::string& run : runs_) {
    paths.emplace_back(run);
    has_reference = has_reference ||
                    fs::path(run).lexically_normal() == fs::path(reference_).lexically_normal();
  }
  if (!has_reference) paths.emplace_back(reference_);
  return paths;
}

std::string StudyArguments::reference(const std::optional<Study>& study) const {
  return study ? study->reference : run_name(reference_);
}

std::vector<PublishedSeries> StudyArguments::published(const std::optional<Study>& study) const {
  std::vector<PublishedSeries> series;
  for (const std::string& file : published_) series.push_back(read_series(file));
  if (study) {
    const fs::path folder = fs::path(study_).parent_path() / ".." / "reference";
    for (const std::string& name : study->published)
      series.push_back(read_series(folder / (name + ".csv")));
  }
  return series;
}

void print_notices(const Run& run) {
  for (const std::string& notice : run.notices)
    std::fprintf(stderr, "%s: notice: %s\n", run.name.c_str(), notice.c_str());
}

}  // namespace surge::compare
