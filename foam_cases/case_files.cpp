#include "foam_cases/case_files.hpp"

#include <algorithm>
#include <cmath>

#include "foam_cases/gates.hpp"
#include "foam_cases/pistons.hpp"
#include "foam_cases/surfaces.hpp"

#include "particle/case/scales.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

using Values = std::map<std::string, std::string>;

/// `key  value;  // comment`, in the columns of caseParameters.
std::string entry(const std::string& key, const std::string& value, const std::string& text) {
  std::string line =
      key + std::string(20 - std::min<std::size_t>(key.size(), 19), ' ') + value + ";";
  if (!text.empty())
    line += std::string(32 - std::min<std::size_t>(line.size(), 30), ' ') + "// " + text;
  return line + '\n';
}

/// The entries of a group. Where the mesh is written out, those of the mesh are comments: to change
/// them in the file would change nothing.
std::string group(const FoamCase& c, const std::string& name) {
  std::string text;
  for (const SettingText& setting : setting_texts(c.settings))
    if (setting.group == name) text += entry(setting.key, setting.value, setting.comment);
  return text;
}

std::string mesh_settings(const FoamCase& c) {
  const std::string count = std::to_string(c.settings.cells_per_length);
  if (c.mesh.squares) {
    return entry("cellsPerL", count,
                 "any whole number; L = " + number_text(c.mesh.length) +
                     " m. All edges of the water fall on cell faces");
  }
  return "// Mesh: " + count + " cells to L = " + number_text(c.mesh.length) +
         " m. Their numbers are in blockMeshDict.\n";
}

/// A value of a line of the template, with room for the comment that follows it.
std::string padded(const std::string& value) {
  return value + ";" + std::string(11 - std::min<std::size_t>(value.size(), 10), ' ');
}

/// A place in a cell that is left of those as high as x, or below them.
Point highest_remaining(const FoamCase& c, const Point& x) {
  const std::size_t up = c.mesh.up;
  const double down = (c.mesh.up_is_plus ? -1.0 : 1.0) * c.mesh.cell;
  for (Point at = x; at[up] > c.mesh.lower(up) && at[up] < c.mesh.upper(up); at[up] += down) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a) {
      if (a == up) continue;
      for (at[a] = c.mesh.lower(a) + 0.25 * c.mesh.cell; at[a] < c.mesh.upper(a);
           at[a] += c.mesh.cell)
        if (!is_cut(c, at)) return at;
      at[a] = x[a];
    }
  }
  throw Error("obstacle: found no cell that is left of the mesh, expected room for the fluid");
}

/// Where the pressure of a tank without an open side is zero: at its highest cell.
std::string pressure_reference(const FoamCase& c) {
  for (const Patch& patch : c.boundaries)
    if (patch.kind == Patch::Kind::open) return {};
  Point highest{};
  double height = -1e300;
  c.mesh.for_each_place([&](const Place& place) {
    const Piece& piece = c.mesh.axes[c.mesh.up][place[c.mesh.up]];
    const double z = c.mesh.up_is_plus ? piece.to : -piece.from;
    if (c.mesh.is_solid(place) || z <= height) return;
    height = z;
    highest = c.mesh.middle(place);
    const std::size_t a = c.mesh.up;
    const auto cell = c.mesh.cell_around(a, c.mesh.up_is_plus ? piece.to : piece.from);
    highest[a] = c.mesh.up_is_plus ? std::min(piece.to, 0.5 * (cell[0] + piece.to))
                                   : std::max(piece.from, 0.5 * (cell[1] + piece.from));
  });
  if (is_cut(c, highest)) highest = highest_remaining(c, highest);
  // Not between two cells, where the place would be found by chance.
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a) {
    const auto cell = c.mesh.cell_around(a, highest[a]);
    if (a != c.mesh.up) highest[a] = cell[0] + 0.25 * (cell[1] - cell[0]);
  }
  return "\n    // No side is open: the pressure is zero here.\n    pRefPoint           " +
         vector_text(highest) + ";\n    pRefValue           0;\n";
}

/// Processes side by side along the axis that has most cells.
std::string parts(const FoamCase& c) {
  std::size_t longest = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (c.mesh.cells_along(a) > c.mesh.cells_along(longest)) longest = a;
  std::string text = "(";
  for (std::size_t a = 0; a < 3; ++a)
    text += std::string(a > 0 ? " " : "") + (a == longest ? "$nProcs" : "1");
  return text + ")";
}

/// constant/hRef: gh is zero at the floor, so that p_rgh = p there; empty where that is at zero.
/// The solver counts hRef along the axis, whichever way gravity points; obliquely it means nothing.
std::string reference_height(const FoamCase& c) {
  const std::size_t a = c.mesh.up;
  const double floor = c.mesh.up_is_plus ? c.mesh.lower(a) : c.mesh.upper(a);
  const double g = length(c.flow.gravity);
  if (floor == 0.0 || g == 0.0 || std::abs(c.flow.gravity[a]) < 0.999999 * g) return {};
  return header("uniformDimensionedScalarField", "hRef") +
         "\ndimensions      [0 1 0 0 0 0 0];\nvalue           " + number_text(floor) +
         ";   // m, the floor's place along gravity's axis\n";
}

/// Gravity along periodic axes, as a force on each volume of the water that fills the tank.
std::string drive(const FoamCase& c) {
  if (length(c.drive) == 0.0) return {};
  Point force = c.drive;
  for (double& component : force) component *= c.flow.density;
  return "\n// Gravity along a periodic axis, where it has no p_rgh: water fills the tank.\n"
         "drive\n{\n    type            vectorSemiImplicitSource;\n    active          yes;\n"
         "    acceleration    " +
         vector_text(c.drive) +
         ";   // m/s2, for manifest.json\n    vectorSemiImplicitSourceCoeffs\n    {\n"
         "        selectionMode   all;\n        volumeMode      specific;\n"
         "        injectionRateSuSp { U (" +
         vector_text(force) + " 0); }   // N/m3\n    }\n}\n";
}

/// constant/fvOptions: what acts on the flow besides gravity; empty where there is nothing.
std::string options(const FoamCase& c) {
  const std::string entries = tank_motion(c) + gate_options(c) + drive(c);
  if (entries.empty()) return {};
  return header("dictionary", "fvOptions") + "\n#include \"../system/caseParameters\"\n" + entries;
}

/// Solver of the displacement of cells, in fvSolution.
constexpr const char* mesh_motion =
    "    \"cellDisplacement.*\"\n    {\n        solver          PCG;\n        preconditioner  "
    "DIC;\n"
    "        tolerance       1e-12;\n        relTol          0;\n    }\n\n";

Values values_of(const FoamCase& c) {
  Values values;
  values["case_file"] = comment(c.source);
  values["title"] = quoted_text(c.flow.title);
  values["wall"] = padded(c.flow.tank.wall == WallCondition::slip ? "slip" : "noSlip");
  values["density"] = padded(number_text(c.flow.density)) + "// kg/m3";
  values["viscosity"] =
      padded(number_text(c.flow.kinematic_viscosity)) + "// m2/s; water at 20 C: 1.0e-6";
  values["gravity"] = vector_text(c.flow.gravity) + ";  // m/s2";
  values["end"] = padded(number_text(c.flow.time.end)) + "// s";
  values["interval"] = padded(number_text(c.flow.output_interval)) + "// s";
  values["mesh_settings"] = mesh_settings(c);
  values["fluid_settings"] = group(c, "fluids");
  values["time_settings"] = group(c, "time");
  values["numerics_settings"] = group(c, "numerics");
  values["running_settings"] = group(c, "running");
  values["instruments"] = instruments(c);
  values["mesh_motion"] = c.pistons.empty() ? "" : mesh_motion;
  values["parts"] = parts(c);
  values["pressure_reference"] = pressure_reference(c);
  return values;
}

}  // namespace

Files case_files(const FoamCase& c) {
  Files files;
  Values values = values_of(c);
  for (const auto& [path, text] : template_files()) {
    const std::string name(path);
    if (name == "0.orig/U") values["boundaries"] = velocity_boundaries(c);
    if (name == "0.orig/alpha.water") values["boundaries"] = alpha_boundaries(c);
    if (name == "0.orig/p_rgh") values["boundaries"] = pressure_boundaries(c);
    files[name] = filled(text, values);
  }
  files["system/blockMeshDict"] = block_mesh(c);
  files["system/setFieldsDict"] = set_fields(c);
  const Files perhaps{{"system/setExprFieldsDict", set_expressions(c)},
                      {"system/topoSetDict", topo_set(c)},
                      {"constant/fvOptions", options(c)},
                      {"constant/movingWalls", moving_walls(c)},
                      {"constant/tankMotion", motion_table(c)},
                      {"constant/hRef", reference_height(c)},
                      {"constant/dynamicMeshDict", dynamic_mesh(c)},
                      {"0.orig/pointDisplacement", point_displacement(c)}};
  for (const Piston& piston : c.pistons) files[piston_file(piston)] = piston_table(c, piston);
  for (const auto& [path, text] : surface_files(c)) files[path] = text;
  for (const auto& [path, text] : perhaps)
    if (!text.empty()) files[path] = text;
  return files;
}

}  // namespace surge::foam
