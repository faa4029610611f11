#include "compare/read/foreign_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "compare/read/first_frame.hpp"
#include "compare/read/foam_case.hpp"
#include "compare/read/layouts.hpp"
#include "compare/read/particle_reader.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

std::string vector_text(const Vec3& x) {
  std::ostringstream text;
  text << '(' << number_text(x[0]) << ", " << number_text(x[1]) << ", " << number_text(x[2]) << ')';
  return text.str();
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Extent extent_of(const std::vector<Vec3>& points) {
  Extent box;
  box.lower.fill(std::numeric_limits<double>::infinity());
  box.upper.fill(-std::numeric_limits<double>::infinity());
  for (const Vec3& x : points)
    for (std::size_t a = 0; a < 3; ++a) {
      if (!std::isfinite(x[a])) continue;
      box.lower[a] = std::min(box.lower[a], x[a]);
      box.upper[a] = std::max(box.upper[a], x[a]);
    }
  return box;
}

/// The first frame as the files have it, for what is asked and guessed.
struct FirstTable {
  ParticleTable table;
  std::vector<Vec3> position;  ///< in the file's axes and units; empty where its names are unknown
  fs::path file;

  FirstTable(const SeriesEntry& entry, SourceOptions& options) : file(entry.files.front()) {
    SeriesEntry first = entry;
    table = read_table(file, first.part, std::nullopt, options);
    if (options.position_array.empty() && table.points.empty())
      options.position_array = usual_position(table);
    if (!options.position_array.empty() || !table.points.empty())
      position = positions(table, VectorField::of(options.position_array), file);
  }

  /// Positions of the fluid alone, as far as it is known.
  [[nodiscard]] std::vector<Vec3> fluid(const SourceOptions& options) const {
    const ParticleArray* type = options.all_fluid ? nullptr : table.find(options.type_array);
    if (type == nullptr || type->components != 1 || type->values.size() != position.size())
      return position;
    std::vector<Vec3> found;
    for (std::size_t i = 0; i < position.size(); ++i)
      if (options.fluid_type.value_or(0).contain(type->values[i])) found.push_back(position[i]);
    return found;
  }

  [[nodiscard]] std::string text() const {
    std::string text = "\nfound in " + file.filename().string() + ": " +
                       std::to_string(table.count) + " particles";
    if (!position.empty()) {
      const Extent box = extent_of(position);
      text += " from " + vector_text(box.lower) + " to " + vector_text(box.upper);
    }
    const std::vector<ArrayFound> arrays = arrays_of(table);
    text += arrays.empty() ? ", points without arrays" : ", arrays:";
    for (const ArrayFound& array : arrays) text += "\n  " + array.text();
    return text;
  }
};

/// What is missing, a line each.
class Questions {
 public:
  void ask(const std::string& what) { lines_ += "\n  " + what; }
  void ask_unless(bool known, const std::string& what) {
    if (!known) ask(what);
  }
  void fail(const Run& run, const Layout& layout, const FirstTable& first) const {
    if (lines_.empty()) return;
    std::string text = run.path.string() + ": expected, because the files do not say it:" + lines_;
    for (const std::string& hint : layout.hints) text += "\n  (a guess) " + hint;
    for (const std::string& notice : layout.notices()) text += "\n" + notice;
    throw Error(text + first.text());
  }

 private:
  std::string lines_;
};

/// Decides which array and values tell fluid from walls, or asks.
void settle_type(const FirstTable& first, SourceOptions& options, Questions& questions,
                 std::vector<std::string>& assumed) {
  if (options.all_fluid) return;
  const std::vector<ArrayFound> arrays = arrays_of(first.table);
  const auto named = std::find_if(arrays.begin(), arrays.end(), [&](const ArrayFound& a) {
    return a.name == options.type_array;
  });
  if (named == arrays.end()) {
    if (options.type_required) return;  // the reader says that it is not there
    for (const ArrayFound& array : arrays)
      if (array.looks_like_a_type())
        questions.ask("--type-array and --fluid-type: \"" + array.name +
                      "\" looks like a type (a guess); --fluid-type all where all are fluid");
    // No file of the series has one from now on.
    options.all_fluid = true;
    return;
  }
  options.type_required = true;
  if (options.fluid_type) return;
  const std::vector<double>& values = named->values;
  if (values.size() == 1) {
    options.fluid_type = TypeValues(std::lround(values[0]));
    assumed.push_back("all particles are fluid: " + named->name + " is " + number_text(values[0]) +
                      " everywhere");
  } else if (std::find(values.begin(), values.end(), 0.0) == values.end()) {
    questions.ask("--fluid-type: which values of " + named->text() + " are fluid");
  } else {
    options.fluid_type = TypeValues(0);
    assumed.push_back("fluid where " + named->name + " is 0 (--fluid-type)");
  }
}

/// The plane of a 2D run tells which axis points up.
void settle_axes(const std::vector<Vec3>& fluid, SourceOptions& options,
                 std::vector<std::string>& assumed) {
  if (options.axes || options.vertical_stated || fluid.empty()) return;
  const Extent box = extent_of(fluid);
  const double spacing = options.spacing->value() / options.units.length;
  const auto flat = [&](std::size_t a) { return box.upper[a] - box.lower[a] < spacing; };
  const auto set = [&](const char* surge, const char* up) {
    const std::vector<std::string> words{surge, up};
    options.axes = FileAxes::parse(words, "axes");
    assumed.push_back(std::string(surge) + " along the surge and " + up +
                      " upwards: all particles lie in one plane (--axes)");
  };
  if (flat(1) && !flat(0) && !flat(2)) return set("x", "z");
  if (flat(0) && !flat(1) && !flat(2)) return set("y", "z");
  if (!flat(2)) assumed.emplace_back("y points upwards (--vertical or --axes)");
}

/// Particles of the column: of water that lies in the tank, what stands out of it.
std::vector<Vec3> column_of(const Run& run, const ParticleFrame& frame,
                            const SourceOptions& options) {
  if (!options.bed_depth) return frame.position;
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  const double bed =
      extent_of(frame.position).lower[up] - 0.5 * run.spacing.value() + options.bed_depth->value();
  std::vector<Vec3> above;
  for (const Vec3& x : frame.position)
    if (x[up] > bed) above.push_back(x);
  if (above.empty())
    throw Error(run.path.string() + ": --bed-depth: found no water above " +
                number_text(options.bed_depth->value()) + " m, a column expected");
  return above;
}

/// Column and tank of a foreign particle series: from its first frame and from what the user says.
void apply_first_frame(Run& run, const ParticleFrame& frame, const SourceOptions& options) {
  run.method = "particles";
  run.spacing = *options.spacing;
  const auto up = static_cast<std::size_t>(options.axes ? 1 : options.vertical_axis);
  Physics& physics = run.physics;
  physics.gravity = Vec3{};
  physics.gravity[up] = -*options.gravity;
  const Extent water = extent_of(frame.position);
  physics.column = extent_of(column_of(run, frame, options));
  physics.column.lower[up] = water.lower[up];
  const bool flat = water.upper[2] - water.lower[2] < run.spacing.value();
  physics.dimension = options.dimension.value_or(flat && up != 2 ? 2 : 3);
  for (std::size_t a = 0; a < 3; ++a) {
    physics.column.lower[a] -= 0.5 * run.spacing.value();
    physics.column.upper[a] += 0.5 * run.spacing.value();
  }
}

/// The first frame's faces are where the column is measured from; one stray particle must not make
/// one.
void tell_lone_faces(Run& run, const std::vector<Vec3>& column) {
  if (column.size() < 20) return;
  const double near = 0.25 * run.spacing.value();
  for (std::size_t a = 0; a < static_cast<std::size_t>(run.physics.dimension); ++a) {
    double low = column[0][a], high = low;
    for (const Vec3& x : column) {
      low = std::min(low, x[a]);
      high = std::max(high, x[a]);
    }
    std::size_t at_low = 0, at_high = 0;
    for (const Vec3& x : column) {
      if (x[a] < low + near) ++at_low;
      if (x[a] > high - near) ++at_high;
    }
    for (const auto& [count, face] : {std::pair{at_low, low}, std::pair{at_high, high}})
      if (count == 1)
        run.notices.push_back("one particle alone makes the column's face at " + six_digits(face) +
                              " m along " + "xyz"[a] + " in the first frame");
  }
}

/// What the user says about the tank: walls that are not known are not finite.
std::optional<Extent> stated_tank(const Physics& physics, const SourceOptions& options) {
  if (!options.tank_width && !options.tank_height) return std::nullopt;
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  Extent tank;
  tank.lower.fill(unknown);
  tank.upper.fill(unknown);
  tank.lower[0] = physics.column.lower[0];
  tank.lower[up] = physics.column.lower[up];
  if (options.tank_width) tank.upper[0] = tank.lower[0] + options.tank_width->value();
  if (options.tank_height) tank.upper[up] = tank.lower[up] + options.tank_height->value();
  return tank;
}

Vec3 centre_of(const std::vector<Vec3>& points) {
  Vec3 sum{};
  for (const Vec3& x : points)
    for (std::size_t a = 0; a < 3; ++a) sum[a] += x[a] / static_cast<double>(points.size());
  return sum;
}

/// Water that starts at rest falls along gravity: its centre sinks along that axis and no other.
void check_fall(Run& run, const ParticleFrame& first, bool stated) {
  const std::size_t frames = run.frames->times().size();
  if (frames < 2) return;
  const auto last = std::get<ParticleFrame>(run.frames->read(frames - 1, Fields{}));
  const Vec3 a = centre_of(first.position), b = centre_of(last.position);
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  const double l0 = run.spacing.value();
  const double sunk = a[up] - b[up];
  if (sunk > -0.5 * l0) {
    // Sideways the water may go as it likes, but across the surge it has no reason to.
    const std::size_t across = 3 - up;
    const double aside = a[across] - b[across];
    if (run.physics.dimension == 2 || aside < 0.5 * l0 || aside < 4.0 * std::abs(sunk)) return;
  }
  const std::string found = "from the first frame to the last the water's centre moves by " +
                            vector_text({b[0] - a[0], b[1] - a[1], b[2] - a[2]}) + " m; ";
  // Waves and tanks that move may lift water; that is for who states the axes to know.
  if (!stated)
    throw Error(run.path.string() + ": " + found +
                "it cannot rise along the axis that points up (--vertical, --axes)");
  run.notices.push_back(found +
                        "water at rest does not rise along the axis that points up (--axes)");
}

void require_start(const Run& run, const std::string& option) {
  const double first = run.frames->times().front().value();
  if (std::abs(first) > 1e-12)
    throw Error(run.path.string() + ": the first time is " + number_text(first) +
                " s: the column at time 0 expected, or " + option);
}

/// A folder without particle files may have one that has.
void require_files(const Run& run, const fs::path& path) {
  if (!fs::is_directory(path) || !stems_of(path).empty()) return;
  std::string inner;
  for (const fs::directory_entry& entry : fs::directory_iterator(path))
    if (entry.is_directory() && !stems_of(entry.path()).empty())
      inner += "\n  " + entry.path().string();
  throw Error(
      run.path.string() +
      ": neither manifest.json, system/controlDict nor numbered files of particles (.vtp, "
      ".vtu, .vtk, .csv, .hdf5, dumps) found, a run folder, an OpenFOAM case or a series of "
      "particle files expected" +
      (inner.empty() ? "" : "; files of particles are in" + inner));
}

}  // namespace

void open_foreign_series(Run& run, const SourceOptions& stated) {
  Layout layout = recognise(run.path, stated);
  SourceOptions& options = layout.options;
  require_files(run, layout.path);
  std::vector<SeriesEntry> entries = list_series(layout.path, options);
  const bool stepped = options.time_step || !options.time_file.empty();
  entries = with_parts(std::move(entries), options);
  const bool has_time = stepped || entries.front().time || entries.front().part.time;

  Questions questions;
  std::vector<std::string> assumed;
  const FirstTable first(entries.front(), options);
  questions.ask_unless(!first.position.empty(),
                       "--position-array: names of the columns or the vector with the positions");
  settle_type(first, options, questions, assumed);
  const std::vector<Vec3> fluid = first.fluid(options);
  std::string nearest;
  if (!options.spacing && fluid.size() > 1)
    nearest = " (a guess: nearest neighbours are " +
              six_digits(nearest_distance(fluid) * options.units.length) + " m apart)";
  questions.ask_unless(options.spacing.has_value(), "--spacing: particle spacing in m" + nearest);
  questions.ask_unless(options.gravity.has_value(), "--gravity: m/s2");
  questions.ask_unless(has_time,
                       "--time-step: seconds from one number in the file names to the next");
  questions.fail(run, layout, first);

  settle_axes(fluid, options, assumed);
  auto series = std::make_unique<ParticleSeries>(std::move(entries), options);
  ParticleSeries& reader = *series;
  run.frames = std::move(series);
  const auto frame = std::get<ParticleFrame>(reader.read(0, Fields{}));
  apply_first_frame(run, frame, options);
  check_first_frame(run, frame, options);
  reader.expect(run.spacing, stated_tank(run.physics, options));
  run.notices = layout.notices();
  check_fall(run, frame, stated.axes || stated.vertical_stated);
  if (!options.column_width) require_start(run, "--column-width");
  tell_lone_faces(run, column_of(run, frame, options));
  for (const std::string& line : assumed) run.notices.push_back("assumed: " + line);
}

}  // namespace surge::compare
