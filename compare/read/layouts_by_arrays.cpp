#include <algorithm>
#include <cmath>

#include "compare/read/delimited.hpp"
#include "compare/read/layouts.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

bool has_all(const ParticleTable& table, const Names& names) {
  return std::all_of(names.begin(), names.end(),
                     [&](const std::string& name) { return table.find(name) != nullptr; });
}

/// Stems that speak of fluid and those that do not.
struct Sorted {
  Names fluid;
  Names others;
};
Sorted sort_stems(const SourceView& view, const std::string& extension) {
  Sorted sorted;
  for (const auto& [stem, files] : view.stems())
    if (stem.ends_with(extension))
      (names_fluid(stem) ? sorted.fluid : sorted.others).push_back(stem);
  return sorted;
}

/// Files of a folder are chosen; of a pattern or a collection the rest is left out.
void choose(const SourceView& view, Layout& layout, const Names& fluid, const Names& walls) {
  if (view.stems().size() > 1) layout.assume_files(fluid, walls);
}

}  // namespace

// TrixiParticles 0.2 to 0.4: <prefix>fluid_<i>_<k>.vtu beside boundary_<i>_<k>.vtu, the time as
// "time", the acceleration as field data "acceleration" where meta data are written.
bool recognise_trixi(const SourceView& view, Layout& layout) {
  const Sorted sorted = sort_stems(view, ".vtu");
  if (sorted.fluid.size() != 1) return false;
  const std::string& stem = sorted.fluid.front();
  if (!has_all(view.table(stem), {"index", "velocity", "density"})) return false;
  layout.program = "TrixiParticles";
  layout.because = stem + " with index, velocity, density";
  choose(view, layout, {stem}, sorted.others);
  layout.assume_velocity({"velocity"});
  layout.assume_pressure("pressure");
  layout.assume_all_fluid();
  return true;
}

// SPHinXsys: <body>_<number>.vtp, SPHBody_<body>_<number>.vtp before 2023; the number is the time
// in millionths of a second or the time step; bodies at rest are written once. "TimeValue" since
// 2025.
bool recognise_sphinxsys(const SourceView& view, Layout& layout) {
  const Sorted sorted = sort_stems(view, ".vtp");
  if (sorted.fluid.size() != 1) return false;
  const std::string& stem = sorted.fluid.front();
  const ParticleTable& table = view.table(stem);
  const auto id = std::find_if(table.arrays.begin(), table.arrays.end(), [](const auto& array) {
    return array.name == "SortedParticle_ID" || array.name == "OriginalParticle_ID" ||
           array.name == "OriginalID" || array.name == "Particle_ID";
  });
  if (id == table.arrays.end()) return false;
  layout.program = "SPHinXsys";
  layout.because = stem + " with " + id->name;
  choose(view, layout, {stem}, sorted.others);
  layout.assume_velocity({"Velocity"});
  layout.assume_pressure("Pressure");
  layout.assume_all_fluid();
  const fs::path& file = view.stems().at(stem).front();
  const bool stated = !layout.options.time_array.empty() || stated_time(file).has_value();
  const auto name = number_in_name(file);
  if (!stated && !layout.options.time_step && layout.options.time_file.empty() && name &&
      name->digits == 10)
    layout.assume(layout.options.time_step, {}, std::optional(Seconds(1e-6)),
                  "the numbers in the names are millionths of a second");
  return true;
}

// SPlisHSPlasH 2.8 to 2.13: vtk/ParticleData_<fluid>_<frame>.vtk, frames from 1 on, at a rate of
// the scene file; walls are no particles of it.
bool recognise_splishsplash(const SourceView& view, Layout& layout) {
  for (const auto& [stem, files] : view.stems()) {
    if (!stem.starts_with("ParticleData_") || !stem.ends_with(".vtk")) continue;
    const std::string head = bytes_between(files.front(), 0, 200);
    if (head.find("SPlisHSPlasH") == std::string::npos) continue;
    layout.program = "SPlisHSPlasH";
    layout.because = stem + " with its title";
    Names others;
    for (const auto& [other, unused] : view.stems())
      if (other != stem) others.push_back(other);
    choose(view, layout, {stem}, others);
    layout.assume_velocity({"velocity"});
    layout.assume_pressure("pressure");
    layout.assume_all_fluid();
    const auto name = number_in_name(files.front());
    if (name && name->number == 1 && !layout.options.first_time) {
      layout.options.first_time = Seconds(0.0);
      layout.assumed.emplace_back("frame 1 is at 0 s");
    }
    layout.hints.emplace_back(
        "--time-step: 0.04 is SPlisHSPlasH's 25 frames per second, if the scene states no "
        "dataExportFPS");
    return true;
  }
  return false;
}

// MPS-Basic: vtu/output_####.vtu, csv/output_####.csv, prof/output_####.prof; 0 ghost, 1 fluid, 2
// wall, 3 dummy wall. The textbook's MPS code and PolyMPS: "ParticleType" with 0 fluid, 2 wall, 3
// dummy wall, -1 ghost.
bool recognise_mps(const SourceView& view, Layout& layout) {
  if (view.stems().size() != 1) return false;
  const std::string& stem = view.stems().begin()->first;
  const ParticleTable& table = view.table(stem);
  const bool basic = has_all(table, {"Particle Type"});
  if (basic || has_all(table, {"ParticleType"})) {
    layout.program = basic ? "MPS-Basic" : "PolyMPS or the MPS textbook's code";
    layout.because = basic ? "Particle Type" : "ParticleType";
    layout.assume_type(table, layout.because,
                       basic ? std::vector<long>{1, 0} : std::vector<long>{0});
    layout.assume_velocity({"Velocity"});
    layout.assume_pressure(table.find("Pressure") != nullptr ? "Pressure" : "pressure");
    return true;
  }
  if (has_all(table, {"type", "fluidType", "x", "y", "z", "vx", "vy", "vz"})) {
    layout.program = "MPS-Basic";
    layout.because = "columns type, fluidType, x to vz";
    layout.assume_type(table, "type", {1, 0});
    layout.assume_velocity({"vx", "vy", "vz"});
    return true;
  }
  if (stem.ends_with(".prof") && table.arrays.size() == 7 && has_all(table, {"1", "7"})) {
    layout.program = "MPS-Basic";
    layout.because = ".prof with 7 columns";
    layout.assume_type(table, "1", {1, 0});
    layout.assume_position({"2", "3", "4"});
    layout.assume_velocity({"5", "6", "7"});
    return true;
  }
  return false;
}

// OpenMps: result/particles_#####.csv with "Type, x, z, u, w, p, n" in 2D, y and v in 3D; 0 fluid,
// 1 wall, 2 dummy, 3 out of the domain; no times.
bool recognise_openmps(const SourceView& view, Layout& layout) {
  if (view.stems().size() != 1) return false;
  const ParticleTable& table = view.table(view.stems().begin()->first);
  if (!has_all(table, {"Type", "x", "z", "u", "w", "p", "n"})) return false;
  const bool space = table.find("y") != nullptr;
  layout.program = "OpenMps";
  layout.because = "columns Type, x, z, u, w, p, n";
  layout.assume_type(table, "Type", {0});
  layout.assume_position(space ? Names{"x", "y", "z"} : Names{"x", "z"});
  layout.assume_velocity(space ? Names{"u", "v", "w"} : Names{"u", "w"});
  layout.assume_pressure("p");
  layout.assume_axes("x", "z");
  return true;
}

// GPUSPH 5: data/PART_#####.vtp beside PLANES.vtu and WaveGage_#####.vtu, times in VTUinp.pvd,
// which names them as groups; "Part type" 0 fluid, 1 boundary, 2 vertex, 3 test point; most
// problems have z upwards.
bool recognise_gpusph(const SourceView& view, Layout& layout) {
  const std::string stem = "PART_*.vtp";
  if (!view.stems().contains(stem)) return false;
  const ParticleTable& table = view.table(stem);
  if (!has_all(table, {"Part type", "Part id"})) return false;
  layout.program = "GPUSPH";
  layout.because = stem + " with Part type";
  Names others;
  for (const auto& [other, files] : view.stems())
    if (other != stem) others.push_back(other);
  choose(view, layout, {stem}, others);
  layout.assume_type(table, "Part type", {0});
  layout.assume_velocity({"Velocity"});
  layout.assume_pressure("Pressure");
  layout.assume_axes("x", "z");
  layout.hints.emplace_back("name VTUinp.pvd instead of the folder: it holds the times");
  return true;
}

// AQUAgpusph 3 to 5: <set>.<k>.vtu with "imove" 1 fluid, 0 sensors, negative for boundaries; times
// in a collection beside them.
bool recognise_aquagpusph(const SourceView& view, Layout& layout) {
  for (const auto& [stem, files] : view.stems()) {
    const ParticleTable& table = view.table(stem);
    if (!has_all(table, {"imove"})) continue;
    layout.program = "AQUAgpusph";
    layout.because = "imove";
    layout.assume_type(table, "imove", {1});
    layout.assume_velocity({"u"});
    layout.assume_pressure("p");
    layout.hints.emplace_back("name the .pvd instead of the folder: it holds the times");
    return true;
  }
  return false;
}

// LAMMPS: text dumps; the time of a step is asked for where the dump does not state it.
bool recognise_lammps(const SourceView& view, Layout& layout) {
  if (view.stems().empty()) return false;
  const fs::path file = view.first_file();
  if (!bytes_between(file, 0, 5).starts_with("ITEM:")) return false;
  const ParticleTable& table = view.table(view.stems().begin()->first);
  layout.program = "LAMMPS";
  layout.because = "ITEM: TIMESTEP";
  if (has_all(table, {"vx", "vy", "vz"})) layout.assume_velocity({"vx", "vy", "vz"});
  layout.hints.emplace_back("--time-step: the seconds of one time step of the dump");
  return true;
}

// Any program whose files are called by what is in them.
bool recognise_names(const SourceView& view, Layout& layout) {
  if (view.stems().size() < 2) return false;
  Names fluid, walls;
  for (const auto& [stem, files] : view.stems()) {
    if (names_wall(stem)) {
      walls.push_back(stem);
    } else if (names_fluid(stem)) {
      fluid.push_back(stem);
    } else {
      return false;
    }
  }
  if (fluid.size() != 1) return false;
  layout.because = "the files' names speak of fluid and of walls";
  choose(view, layout, fluid, walls);
  layout.assume_all_fluid();
  return true;
}

}  // namespace surge::compare
