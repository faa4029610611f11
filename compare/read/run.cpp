#include "compare/read/run.hpp"

#include <algorithm>
#include <cmath>

#include "compare/read/first_column.hpp"
#include "compare/read/first_frame.hpp"
#include "compare/read/foam_case.hpp"
#include "compare/read/foreign_series.hpp"
#include "compare/read/particle_reader.hpp"
#include "compare/read/readers.hpp"
#include "compare/read/recorded.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// Our own manifest states all that the options could say; saying it twice would hide a mistake.
void refuse_options(const fs::path& path, const SourceOptions& o) {
  const SourceOptions usual;
  const bool facts = o.column_width || o.column_height || o.gravity || o.tank_width ||
                     o.tank_height || o.bed_depth || o.density || o.spacing || o.dimension ||
                     o.time_step || o.first_time;
  const bool names = o.axes || o.vertical_stated || !o.format.empty() || !o.files.empty() ||
                     !o.walls.empty() || !o.groups.empty() || !o.position_array.empty() ||
                     o.velocity_array != usual.velocity_array ||
                     o.pressure_array != usual.pressure_array || o.type_required || o.fluid_type ||
                     o.all_fluid || !o.time_array.empty() || !o.time_file.empty();
  if (facts || names)
    throw Error(path.string() +
                ": has a manifest.json that states the case and the files, so options about files "
                "(--spacing, --gravity, --type-array and the like) are not for it");
}

/// The names in our own files.
SourceOptions own_names() {
  SourceOptions options;
  options.type_required = true;
  options.time_stated = true;
  return options;
}

/// The path as the user means it: particles.pvd inside a run folder is the run.
fs::path source_path(const fs::path& given) {
  const fs::path path = foam_case_folder(given);
  const bool ours =
      path.filename() == "particles.pvd" && fs::exists(path.parent_path() / "manifest.json");
  if (!ours) return path;
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path place_of(const fs::path& given) {
  const fs::path place = fs::absolute(source_path(given)).lexically_normal();
  return place.has_filename() ? place : place.parent_path();
}

}  // namespace

std::string run_name(const fs::path& path) {
  return place_of(path).filename().string();
}

std::vector<std::string> run_names(const std::vector<fs::path>& paths) {
  std::vector<fs::path> places;
  for (const fs::path& path : paths) places.push_back(place_of(path));
  std::vector<std::string> names;
  for (const fs::path& place : places) {
    fs::path name = place.filename(), above = place.parent_path();
    const auto is_of_another = [&](const fs::path& other) {
      return other != place && (fs::path("/") / other).string().ends_with('/' + name.string());
    };
    while (above.has_filename() && std::any_of(places.begin(), places.end(), is_of_another)) {
      name = above.filename() / name;
      above = above.parent_path();
    }
    names.push_back(name.string());
  }
  return names;
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

namespace {

/// Cells are cut out for a body with a surface, and water does not slide along stairs.
void tell_of_stairs(Run& run) {
  if (!run.physics.obstacles) return;
  const auto stairs = std::count_if(run.physics.obstacles->begin(), run.physics.obstacles->end(),
                                    [](const SolidBody& body) { return body.surface != nullptr; });
  if (stairs > 0)
    run.notices.push_back(
        "inclined faces of obstacles (" + std::to_string(stairs) +
        ") are stairs of cells: thin water along them is held back, and the force on "
        "them has a part along the face, which shrinks slowly with the cells");
}

}  // namespace

Run open_run(const fs::path& given, const SourceOptions& options) {
  Run run;
  run.path = source_path(given);
  run.name = run_name(given);
  const bool folder = fs::is_directory(run.path);
  const bool pattern = run.path.filename().string().find('*') != std::string::npos;
  if (!folder && !pattern && !fs::exists(run.path))
    throw Error(run.path.string() + ": no such file or folder");
  const fs::path manifest = run.path / "manifest.json";
  const bool stated = folder && fs::exists(fs::symlink_status(manifest));
  if (stated) {
    refuse_options(run.path, options);
    apply_manifest(run, manifest);
  }
  if (folder && fs::exists(run.path / "system" / "controlDict")) {
    run.kind = SourceKind::openfoam;
    run.frames = open_foam_case(run.path, options);
    if (stated) {
      check_foam_case(run);
      tell_of_stairs(run);
    } else {
      apply_foam_case(run, options);
    }
  } else if (stated) {
    run.kind = SourceKind::particle_run;
    run.frames = open_particle_series(list_series(run.path / "particles.pvd"), own_names());
    check_first_frame(run, std::get<ParticleFrame>(run.frames->read(0, Fields{})), options);
  } else {
    run.kind = SourceKind::particle_series;
    open_foreign_series(run, options);
  }
  if (!stated) apply_options(run, options);
  check_recorded(run);
  if (run.kind == SourceKind::openfoam && !run.cells_per_width) {
    run.cells_per_width = run.physics.column_width() / run.spacing;
  }
  return run;
}

}  // namespace surge::compare
