#include <algorithm>
#include <cmath>
#include <sstream>

#include "compare/read/delimited.hpp"
#include "compare/read/hdf5_file.hpp"
#include "compare/read/isolated.hpp"
#include "compare/read/layouts.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// Text of one of a program's own small files; empty where it is not there or large.
std::string small_text(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed) || fs::file_size(file, failed) > (8U << 20U)) return {};
  return bytes_between(file, 0, 0);
}

/// Dp of Run.csv: `#RunName;...;Dp;...` over its values.
std::optional<double> particle_distance(const fs::path& folder) {
  std::istringstream in(small_text(folder / "Run.csv"));
  std::string names, values;
  if (!std::getline(in, names) || !std::getline(in, values)) return std::nullopt;
  std::vector<std::string_view> keys, words;
  split_fields(names, ';', keys);
  split_fields(values, ';', words);
  const auto found = std::find(keys.begin(), keys.end(), "Dp");
  const auto at = static_cast<std::size_t>(found - keys.begin());
  if (found == keys.end() || at >= words.size()) return std::nullopt;
  const auto value = number_in(words[at]);
  return value && std::isfinite(*value) && *value > 0.0 ? value : std::nullopt;
}

/// `Gravity=(0,0,-9.81)` of Run.out.
std::optional<Vec3> stated_gravity(const fs::path& folder) {
  const std::string text = small_text(folder / "Run.out");
  const auto at = text.find("\nGravity=(");
  if (at == std::string::npos) return std::nullopt;
  const auto begin = at + std::string("\nGravity=(").size();
  std::vector<std::string_view> words;
  split_fields(std::string_view(text).substr(begin, text.find(')', begin) - begin), ',', words);
  Vec3 gravity{};
  if (words.size() != 3) return std::nullopt;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto value = number_in(words[a]);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    gravity[a] = *value;
  }
  return gravity;
}

/// Facts in Run.csv, Run.out and RunPARTs.csv of the folder that was given.
void read_run_files(const SourceView& view, Layout& layout) {
  SourceOptions& options = layout.options;
  const fs::path& root = view.folder();
  if (const auto distance = particle_distance(root); distance && !options.spacing) {
    options.spacing = Metres(*distance);
    layout.read.push_back("spacing " + number_text(*distance) + " m read from Run.csv (Dp)");
  }
  const auto gravity = stated_gravity(root);
  if (gravity && !options.gravity && (*gravity)[0] == 0.0 && (*gravity)[1] == 0.0 &&
      (*gravity)[2] < 0.0) {
    options.gravity = -(*gravity)[2];
    layout.read.push_back("gravity " + number_text(*options.gravity) + " m/s2 read from Run.out");
  }
  if (!options.time_step && options.time_file.empty() && fs::exists(root / "RunPARTs.csv")) {
    options.time_file = root / "RunPARTs.csv";
    layout.read.emplace_back("times read from RunPARTs.csv");
  }
}

/// The stem with the fluid: alone, else with the walls.
std::string dualsphysics_stem(const SourceView& view) {
  for (const std::string name : {"PartFluid", "PartAll", "PartVtk", "PartCsv", "Part"})
    for (const char* extension : {"_*.vtk", "_*.csv"}) {
      std::string stem = name + extension;
      if (!view.stems().contains(stem)) continue;
      const ParticleTable& table = view.table(stem);
      if (table.find("Idp") != nullptr) return stem;
    }
  return {};
}

}  // namespace

// DualSPHysics 5: PartFluid_####.vtk or .csv of PartVTK in particles/, PartVtk_####.vtk (-sv:vtk)
// and PartCsv_####.csv (-sv:csv) of the solver; "Type" 0 fixed, 1 moving, 2 floating, 3 fluid; z
// upwards; times in RunPARTs.csv.
bool recognise_dualsphysics(const SourceView& given, Layout& layout) {
  SourceView view = given;
  std::string stem = dualsphysics_stem(view);
  if (stem.empty() && given.is_folder()) {
    for (const char* inner : {"particles", "vtks", "data"}) {
      if (!fs::is_directory(given.folder() / inner)) continue;
      view = given.inside(inner);
      stem = dualsphysics_stem(view);
      if (stem.empty()) continue;
      layout.path = given.folder() / inner;
      layout.assumed.push_back("files in " + std::string(inner) + "/");
      break;
    }
  }
  if (stem.empty()) return false;
  const ParticleTable& table = view.table(stem);
  const bool csv = stem.ends_with(".csv");
  layout.program = "DualSPHysics";
  layout.because = stem + " with Idp";
  if (view.stems().size() > 1) {
    Names others;
    for (const auto& [other, files] : view.stems())
      if (other != stem) others.push_back(other);
    layout.assume_files({stem}, others);
  }
  layout.assume_type(table, "Type", {3});
  if (table.find("Type") == nullptr && stem.starts_with("PartFluid")) layout.assume_all_fluid();
  layout.assume_axes("x", "z");
  if (csv) {
    layout.assume_position({"Pos.x [m]", "Pos.y [m]", "Pos.z [m]"});
    layout.assume_velocity({"Vel.x [m/s]", "Vel.y [m/s]", "Vel.z [m/s]"});
    layout.assume_pressure("Press [Pa]");
  } else {
    layout.assume_velocity({"Vel"});
    layout.assume_pressure("Press");
  }
  if (given.is_folder()) read_run_files(given, layout);
  if (!layout.options.time_step && layout.options.time_file.empty())
    layout.hints.emplace_back(
        "--time-file: RunPARTs.csv in the run's folder holds the times (or name that folder)");
  return true;
}

namespace {

/// The bodies of a file of PySPH; none of another's.
Names pysph_bodies(const fs::path& file) {
  std::istringstream said(in_child(file, [&] {
    const Hdf5File opened(file);
    std::string names;
    if (!opened.has_group("particles") || !opened.has_group("solver_data")) return names;
    for (const std::string& body : opened.members("particles", true)) {
      if (!opened.has_group("particles/" + body + "/arrays")) return std::string();
      names += body + '\n';
    }
    return names;
  }));
  Names bodies;
  for (std::string body; std::getline(said, body);) bodies.push_back(body);
  return bodies;
}

}  // namespace

// PySPH: <case>_<step>.hdf5 with particles/<name>/arrays and the time as attribute t of
// solver_data; x, y, z, u, v, w, p.
bool recognise_pysph(const SourceView& view, Layout& layout) {
  if (!layout.options.groups.empty() || view.stems().empty()) return false;
  const fs::path file = view.first_file();
  Names fluid, walls;
  try {
    if (format_of(file, layout.options) != Format::hdf5) return false;
    const Names bodies = pysph_bodies(file);
    if (bodies.empty()) return false;
    for (const std::string& body : bodies) (names_fluid(body) ? fluid : walls).push_back(body);
    const bool all_known = std::all_of(walls.begin(), walls.end(), names_wall);
    layout.program = "PySPH";
    layout.because = "particles/*/arrays and solver_data";
    const std::string found = comma_list(bodies);
    if (fluid.empty() || !all_known) {
      layout.hints.push_back("--groups: particles/NAME/arrays of the fluid; names: " + found);
      return true;
    }
    for (const std::string& body : fluid)
      layout.options.groups.push_back("particles/" + body + "/arrays");
    for (const std::string& body : fluid) layout.assumed.push_back("fluid in particles/" + body);
    if (layout.options.time_array.empty() && !layout.options.time_step &&
        layout.options.time_file.empty())
      layout.options.time_array = "solver_data@t";
  } catch (const Error&) {
    return false;  // who reads it says what is wrong
  }
  layout.assume_position({"x", "y", "z"});
  layout.assume_velocity({"u", "v", "w"});
  layout.assume_pressure("p");
  layout.assume_all_fluid();
  return true;
}

namespace {

/// The units that a file of SWIFT states, in m, s and kg; none where it states none.
struct StatedUnits {
  std::optional<double> length;
  std::optional<double> time;
  std::optional<double> mass;

  [[nodiscard]] std::optional<double> pressure() const {
    if (!length || !time || !mass) return std::nullopt;
    return *mass / (*length * *time * *time);
  }
};

/// What a file in the manner of Gadget states; empty where it is none.
struct GadgetFile {
  bool is_one = false;
  StatedUnits units;
  Names others;  ///< kinds of particles beside PartType0
};

GadgetFile gadget_file(const fs::path& file) {
  std::istringstream said(in_child(file, [&] {
    const Hdf5File opened(file);
    if (!opened.has_group("PartType0") || !opened.has_group("Header") ||
        !opened.data_set("PartType0", "Coordinates"))
      return std::string();
    const auto unit = [&](const char* name) {
      const auto value = opened.has_group("Units") ? opened.attribute("Units", name) : std::nullopt;
      return value ? number_text(*value) : std::string("-");
    };
    std::string text = unit("Unit length in cgs (U_L)") + '\n' + unit("Unit time in cgs (U_t)") +
                       '\n' + unit("Unit mass in cgs (U_M)") + '\n';
    for (const std::string& group : opened.members("", true))
      if (group.starts_with("PartType") && group != "PartType0") text += group + '\n';
    return text;
  }));
  GadgetFile found;
  std::string length, time, mass;
  if (!std::getline(said, length) || !std::getline(said, time) || !std::getline(said, mass))
    return found;
  found.is_one = true;
  if (const auto value = number_in(length)) found.units.length = 0.01 * *value;
  found.units.time = number_in(time);
  if (const auto value = number_in(mass)) found.units.mass = 1e-3 * *value;
  for (std::string other; std::getline(said, other);) found.others.push_back(other);
  return found;
}

}  // namespace

// SWIFT, Gadget 4, GIZMO: snap_####.hdf5 with PartType0/Coordinates and Header@Time; SWIFT states
// its units. PartType0 is what flows.
bool recognise_gadget(const SourceView& view, Layout& layout) {
  if (view.stems().empty()) return false;
  SourceOptions& options = layout.options;
  if (!options.groups.empty() && options.groups != Names{"PartType0"}) return false;
  GadgetFile file;
  try {
    if (format_of(view.first_file(), options) != Format::hdf5) return false;
    file = gadget_file(view.first_file());
  } catch (const Error&) {
    return false;  // who reads it says what is wrong
  }
  if (!file.is_one) return false;
  layout.program = "SWIFT and Gadget";
  layout.because = "PartType0/Coordinates and Header";
  layout.assume(options.groups, {}, {"PartType0"}, "fluid in PartType0");
  if (!file.others.empty()) layout.assumed.push_back("no fluid in " + file.others.front());
  if (!options.time_step && options.time_file.empty() && options.time_array.empty())
    options.time_array = "Header@Time";
  layout.assume_position({"Coordinates"});
  layout.assume_velocity({"Velocities"});
  layout.assume_pressure("Pressures");
  layout.assume_all_fluid();
  const auto take = [&](double& unit, const std::optional<double>& stated, const std::string& key,
                        const std::string& name) {
    if (!stated || options.stated.contains(key) || *stated == unit) return;
    unit = *stated;
    layout.read.push_back(name + " of " + number_text(unit) + " read from Units");
  };
  take(options.units.length, file.units.length, "length_unit", "a unit of length in m");
  take(options.units.time, file.units.time, "time_unit", "a unit of time in s");
  take(options.units.pressure, file.units.pressure(), "pressure_unit", "a unit of pressure in Pa");
  return true;
}

}  // namespace surge::compare
