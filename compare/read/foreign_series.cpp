#include "compare/read/foreign_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "compare/read/first_column.hpp"
#include "compare/read/first_frame.hpp"
#include "compare/read/foam_case.hpp"
#include "compare/read/layouts.hpp"
#include "compare/read/particle_reader.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

std::string comma_list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
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
    const FluidTypes types(options);
    if (type->is_text() == types.words.empty()) return position;
    const std::vector<bool> is_fluid = types.fluid(*type, file);
    std::vector<Vec3> found;
    for (std::size_t i = 0; i < position.size(); ++i)
      if (is_fluid[i]) found.push_back(position[i]);
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
  if (!named->words.empty()) {
    std::vector<std::string> fluid;
    for (const std::string& word : named->words)
      if (names_fluid(word)) fluid.push_back(word);
    if (fluid.size() != 1)
      return questions.ask("--fluid-type: which words of " + named->text() + " are fluid");
    options.fluid_type = TypeValues::parse(fluid, named->name);
    options.stated["fluid_type"] = fluid;
    assumed.push_back("fluid where " + named->name + " is " + fluid.front() + " (--fluid-type)");
  } else if (values.size() == 1) {
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

/// Pressures and velocities that the files do not hold, and that nobody named, are not read.
void drop_absent_fields(const FirstTable& first, SourceOptions& options) {
  const auto absent = [&](const std::string& name) { return first.table.find(name) == nullptr; };
  if (!options.stated.contains("pressure_array") && absent(options.pressure_array))
    options.pressure_array.clear();
  const std::vector<std::string>& names = options.velocity_array;
  if (!options.stated.contains("velocity_array") && std::any_of(names.begin(), names.end(), absent))
    options.velocity_array.clear();
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

/// A folder without particle files may have one that has.
void require_files(const Run& run, const fs::path& path) {
  if (!fs::is_directory(path) || !stems_of(path).empty()) return;
  std::string inner;
  for (const fs::directory_entry& entry : fs::directory_iterator(path))
    if (entry.is_directory() && !stems_of(entry.path()).empty())
      inner += "\n  " + entry.path().string();
  const std::string unread = unread_file_in(path);
  throw Error(
      run.path.string() +
      ": neither manifest.json, system/controlDict nor numbered files of particles (.vtp, "
      ".vtu, .vtk, .csv, .hdf5, dumps) found, a run folder, an OpenFOAM case or a series of "
      "particle files expected" +
      (inner.empty() ? "" : "; files of particles are in" + inner) +
      (unread.empty() ? "" : "; " + unread));
}

/// How the files are read, by whoever it was decided.
std::map<std::string, std::string> reading_of(const Run& run, const Layout& layout,
                                              const SourceOptions& options) {
  std::map<std::string, std::string> facts{{"spacing", number_text(options.spacing->value())},
                                           {"gravity", number_text(*options.gravity)},
                                           {"dimension", std::to_string(run.physics.dimension)},
                                           {"axes", options.axes ? options.axes->text()
                                                    : options.vertical_axis == 2 ? "x, z"
                                                                                 : "x, y"}};
  if (!layout.program.empty()) facts["program"] = layout.program;
  if (!options.position_array.empty()) facts["position_array"] = comma_list(options.position_array);
  if (!options.all_fluid) facts["type_array"] = options.type_array;
  facts["fluid_type"] = options.all_fluid ? "all" : FluidTypes(options).text();
  return facts;
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
  drop_absent_fields(first, options);
  auto series = std::make_unique<ParticleSeries>(std::move(entries), options);
  ParticleSeries& reader = *series;
  run.frames = std::move(series);
  run.notices = layout.notices();
  settle_column(run, options, stated.axes || stated.vertical_stated,
                [&](Metres spacing, const auto& tank) { reader.expect(spacing, tank); });
  for (const std::string& line : assumed) run.notices.push_back("assumed: " + line);
  run.reading = reading_of(run, layout, options);
}

}  // namespace surge::compare
