#include "compare/read/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/read/first_frame.hpp"
#include "compare/read/foam_case.hpp"
#include "compare/read/readers.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Lower and upper corner of points.
Extent extent_of(std::size_t count, const auto& point) {
  Extent box;
  box.lower.fill(std::numeric_limits<double>::infinity());
  box.upper.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 x = point(i);
    for (std::size_t a = 0; a < 3; ++a) {
      box.lower[a] = std::min(box.lower[a], x[a]);
      box.upper[a] = std::max(box.upper[a], x[a]);
    }
  }
  return box;
}

void require_start(const Run& run, const std::string& option) {
  if (std::abs(run.frames->times().front().value()) > 1e-12) {
    throw Error(run.path.string() + ": the first time is " +
                std::to_string(run.frames->times().front().value()) +
                " s: the column at time 0 expected, or " + option);
  }
}

/// What the files of a series do not say and the user has not said, asked for all at once with what
/// was found.
void ask_for_missing(const fs::path& path, const fs::path& first, bool has_time,
                     const SourceOptions& options) {
  const std::vector<ArrayFound> arrays = arrays_of(first);
  const bool has_usual_type = std::any_of(arrays.begin(), arrays.end(), [&](const ArrayFound& a) {
    return a.name == options.type_array;
  });
  std::string missing;
  const auto ask = [&](const std::string& what) { missing += "\n  " + what; };
  if (!options.spacing) ask("--spacing: particle spacing in m");
  if (!options.gravity) ask("--gravity: m/s2");
  if (!has_time) ask("--time-step: seconds from one number in the file names to the next");
  if (!options.type_required && !has_usual_type) {
    for (const ArrayFound& array : arrays) {
      if (!array.looks_like_a_type()) continue;
      ask("--type-array and --fluid-type: \"" + array.name + "\" looks like a type");
    }
  }
  if (missing.empty()) return;
  std::string found;
  for (const ArrayFound& array : arrays) found += "\n  " + array.text();
  throw Error(path.string() + ": expected, because the files do not say it:" + missing +
              "\nfound in " + first.filename().string() +
              (found.empty() ? ": points without arrays" : ", point arrays:" + found));
}

/// Column and tank of a foreign particle series: from its first frame and from what the user says.
void apply_series(Run& run, const SourceOptions& options) {
  run.method = "particles";
  run.spacing = *options.spacing;
  const auto up = static_cast<std::size_t>(options.vertical_axis);
  Physics& physics = run.physics;
  physics.gravity = Vec3{};
  physics.gravity[up] = -*options.gravity;
  const auto frame = std::get<ParticleFrame>(run.frames->read(0, Fields{}));
  const Extent water =
      extent_of(frame.position.size(), [&](std::size_t i) { return frame.position[i]; });
  physics.column = water;
  if (options.bed_depth) {
    // The column is what stands out of the water that lies in the tank.
    const double bed = water.lower[up] - 0.5 * run.spacing.value() + options.bed_depth->value();
    std::vector<Vec3> above;
    for (const Vec3& x : frame.position)
      if (x[up] > bed) above.push_back(x);
    if (above.empty())
      throw Error(run.path.string() + ": --bed-depth: found no water above " +
                  number_text(options.bed_depth->value()) + " m, a column expected");
    physics.column = extent_of(above.size(), [&](std::size_t i) { return above[i]; });
    physics.column.lower[up] = water.lower[up];
  }
  const bool flat = water.upper[2] - water.lower[2] < run.spacing.value();
  physics.dimension = options.dimension.value_or(flat && up != 2 ? 2 : 3);
  for (std::size_t a = 0; a < 3; ++a) {
    physics.column.lower[a] -= 0.5 * run.spacing.value();
    physics.column.upper[a] += 0.5 * run.spacing.value();
  }
  check_first_frame(run, frame, options);
  if (!options.column_width) require_start(run, "--column-width");
}

void apply_options(Run& run, const SourceOptions& options) {
  Physics& physics = run.physics;
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  if (options.column_width)
    physics.column.upper[0] = physics.column.lower[0] + options.column_width->value();
  if (options.column_height)
    physics.column.upper[up] = physics.column.lower[up] + options.column_height->value();
  if (options.density) physics.density = *options.density;
  if (options.bed_depth) physics.stated_bed = *options.bed_depth;
  if (options.tank_width) {
    if (!physics.tank) {
      physics.tank = physics.column;
      physics.tank->upper.fill(unknown);
    }
    physics.tank->upper[0] = physics.column.lower[0] + options.tank_width->value();
  }
}

/// Our own manifest states all that the options could say; saying it twice would hide a mistake.
void refuse_options(const fs::path& path, const SourceOptions& options) {
  if (options.column_width || options.column_height || options.gravity || options.tank_width ||
      options.spacing || options.dimension || options.time_step || options.bed_depth ||
      options.density) {
    throw Error(path.string() +
                ": has a manifest.json that states the case, so --column-width, --column-height, "
                "--gravity, --tank-width, --spacing, --dimension, --time-step, --bed-depth and "
                "--density are not for it");
  }
}

SourceOptions without_foreign_names(SourceOptions options) {
  const SourceOptions usual;
  options.velocity_array = usual.velocity_array;
  options.pressure_array = usual.pressure_array;
  options.type_array = usual.type_array;
  options.fluid_type = usual.fluid_type;
  options.type_required = true;
  return options;
}

bool has_particle_files(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) {
                       const std::string extension = entry.path().extension().string();
                       return extension == ".vtp" || extension == ".vtu" || extension == ".vtk";
                     });
}

/// The path as the user means it: particles.pvd inside a run folder is the run.
fs::path source_path(const fs::path& given) {
  const fs::path path = foam_case_folder(given);
  const bool ours =
      path.filename() == "particles.pvd" && fs::exists(path.parent_path() / "manifest.json");
  if (!ours) return path;
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

std::string run_name(const fs::path& path) {
  fs::path plain = fs::absolute(source_path(path)).lexically_normal();
  if (!plain.has_filename()) plain = plain.parent_path();
  return plain.filename().string();
}

std::optional<std::size_t> frame_near(const std::vector<Seconds>& times, Seconds time) {
  const auto distance = [&](Seconds t) { return std::abs((t - time).value()); };
  const auto nearest = std::min_element(
      times.begin(), times.end(), [&](Seconds a, Seconds b) { return distance(a) < distance(b); });
  const auto index = static_cast<std::size_t>(nearest - times.begin());
  double interval = 0.0;
  if (index > 0) interval = (times[index] - times[index - 1]).value();
  if (index + 1 < times.size()) {
    interval = std::max(interval, (times[index + 1] - times[index]).value());
  }
  // Rounded times are not a reason to miss a frame.
  if (distance(*nearest) > 0.5 * interval + 1e-9) return std::nullopt;
  return index;
}

Seconds time_of(const Frame& frame) {
  return std::visit([](const auto& f) { return f.time; }, frame);
}

Run open_run(const fs::path& given, const SourceOptions& options) {
  Run run;
  run.path = source_path(given);
  run.name = run_name(given);
  const bool folder = fs::is_directory(run.path);
  const bool pattern = run.path.filename().string().find('*') != std::string::npos;
  if (!folder && !pattern && !fs::exists(run.path))
    throw Error(run.path.string() + ": no such file or folder");
  const fs::path manifest = run.path / "manifest.json";
  const bool stated = folder && fs::exists(manifest);
  if (stated) {
    refuse_options(run.path, options);
    apply_manifest(run, manifest);
  }
  if (folder && fs::exists(run.path / "system" / "controlDict")) {
    run.kind = SourceKind::openfoam;
    run.frames = open_foam_case(run.path, options);
    if (stated) {
      check_foam_case(run);
    } else {
      apply_foam_case(run, options);
    }
  } else if (stated) {
    run.kind = SourceKind::particle_run;
    run.frames = open_particle_series(list_series(run.path / "particles.pvd"),
                                      without_foreign_names(options));
    check_first_frame(run, std::get<ParticleFrame>(run.frames->read(0, Fields{})), options);
  } else {
    if (folder && !has_particle_files(run.path)) {
      throw Error(run.path.string() +
                  ": neither manifest.json, system/controlDict nor .vtp, .vtu, .vtk files found, a "
                  "run folder, an "
                  "OpenFOAM case or a series of particle files expected");
    }
    run.kind = SourceKind::particle_series;
    std::vector<SeriesEntry> entries = list_series(run.path);
    const fs::path first = entries.front().files.front();
    const bool has_time = options.time_step || entries.front().time || stated_time(first);
    ask_for_missing(run.path, first, has_time, options);
    run.frames = open_particle_series(std::move(entries), options);
    apply_series(run, options);
  }
  if (!stated) apply_options(run, options);
  if (run.kind == SourceKind::openfoam && !run.cells_per_width) {
    run.cells_per_width = run.physics.column_width() / run.spacing;
  }
  return run;
}

}  // namespace surge::compare
