#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "foam_cases/case_files.hpp"
#include "foam_cases/gates.hpp"
#include "foam_cases/surfaces.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

/// A place inside the mesh by a millionth of L: OpenFOAM finds no cell on a wall.
Point inside(const FoamCase& c, const Probe& probe) {
  Point x = probe.position;
  const double step = 1e-6 * c.settings.length;
  if (c.flow.dimension == 2) x[2] = 0.5 * (c.mesh.lower(2) + c.mesh.upper(2));
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a)
    x[a] = std::clamp(x[a], c.mesh.lower(a) + step, c.mesh.upper(a) - step);
  for (const Obstacle& obstacle : c.flow.obstacles) {
    if (obstacle.surface) continue;
    const Box box = in_three_dimensions(c.flow, c.mesh, obstacle);
    // Out through the face that it lies on.
    double deepest = 0.0;
    std::size_t axis = 0;
    bool plus = true, in = true;
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a) {
      const double above = x[a] - box.lower[a], below = box.upper[a] - x[a];
      in = in && above > -step && below > -step;
      const double depth = std::min(above, below);
      if (a == 0 || depth < deepest) {
        deepest = depth;
        axis = a;
        plus = below < above;
      }
    }
    if (in) x[axis] = plus ? box.upper[axis] + step : box.lower[axis] - step;
  }
  return in_remaining_cell(c, x, "probe \"" + probe.name + "\"");
}

std::string probe_text(const FoamCase& c, const Probe& probe) {
  const std::string name = word(probe.name);
  return "\n    // postProcessing/" + name +
         ": p at a place, Pa, at every step. Between the corners of cells it is\n    // linear, so "
         "that the place may lie on a face between two of them; on a wall it is inside the mesh "
         "by\n"
         "    // a millionth of L.\n    " +
         name +
         "\n    {\n        type            probes;\n        libs            (sampling);\n"
         "        fields          (p);\n        interpolationScheme cellPoint;\n"
         "        probe           " +
         quoted_text(probe.name) + ";   // its name in manifest.json\n        position        " +
         vector_text(probe.position) + ";\n        probeLocations  ( " +
         vector_text(inside(c, probe)) + " );\n    }\n";
}

/// Name of the cells that a gauge looks at.
std::string zone(const Gauge& gauge) {
  return word(gauge.name) + "Column";
}

/// Box of the cells along gravity at the place of a gauge: one across, two where it is on a face.
Box column(const FoamCase& c, const Gauge& gauge) {
  Box box = in_three_dimensions(c.flow, c.mesh, {});
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a) {
    if (a == c.mesh.up) {
      box.lower[a] = c.mesh.lower(a);
      box.upper[a] = c.mesh.upper(a);
    } else {
      const auto faces = c.mesh.cell_around(a, gauge.position[a]);
      box.lower[a] = faces[0];
      box.upper[a] = faces[1];
    }
  }
  return box;
}

/// Height (m) of what is left of a piece of a column where surfaces are cut out.
double open_part(const FoamCase& c, const Box& column, const Piece& piece) {
  if (!has_surfaces(c.flow)) return piece.to - piece.from;
  Point x{};
  for (std::size_t a = 0; a < 3; ++a) x[a] = column.lower[a] + 1e-3 * c.mesh.cell;
  double height = 0.0;
  for (double from = piece.from; from < piece.to - 1e-6 * c.mesh.cell;) {
    x[c.mesh.up] = from + 1e-3 * c.mesh.cell;
    const double to = c.mesh.cell_around(c.mesh.up, x[c.mesh.up])[1];
    if (!is_cut(c, x)) height += to - from;
    from = to;
  }
  return height;
}

/// Height (m) of a column of cells, without obstacles.
double open_height(const FoamCase& c, const Box& column) {
  Place place{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double x = column.lower[a] + 1e-3 * c.mesh.cell;
    while (a != c.mesh.up && place[a] + 1 < c.mesh.count(a) && c.mesh.axes[a][place[a]].to < x)
      ++place[a];
  }
  double height = 0.0;
  for (std::size_t k = 0; k < c.mesh.count(c.mesh.up); ++k) {
    place[c.mesh.up] = k;
    const Piece& piece = c.mesh.axes[c.mesh.up][k];
    if (!c.mesh.is_solid(place)) height += open_part(c, column, piece);
  }
  return height;
}

std::string gauge_text(const FoamCase& c, const Gauge& gauge) {
  const Box box = column(c, gauge);
  double area = 1.0;
  for (std::size_t a = 0; a < 3; ++a)
    if (a != c.mesh.up) area *= box.upper[a] - box.lower[a];
  const std::string name = word(gauge.name);
  // Cells of a mesh that moves change their area, and not the part of them that is water.
  const bool moves = !c.pistons.empty();
  std::ostringstream out;
  out << "\n    // postProcessing/" << name
      << (moves
              ? ": part of the cells above and below a place that is water, at every step;\n"
                "    // times `height` it is the height of the water there.\n    "
              : ": volume of water in the cells above and below a place, m3, at every step; over\n"
                "    // `area` it is the height of the water there.\n    ")
      << name
      << "\n    {\n        type            volFieldValue;\n        libs            "
         "(fieldFunctionObjects);\n"
         "        operation       "
      << (moves ? "volAverage" : "volIntegrate")
      << ";\n        regionType      cellZone;\n"
         "        name            "
      << zone(gauge)
      << ";\n        fields          (alpha.water);\n        writeFields     no;\n"
         "        log             no;\n        gauge           "
      << quoted_text(gauge.name) << ";   // its name in manifest.json\n        position        "
      << vector_text(gauge.position) << ";\n        "
      << (moves ? "height          " + number_text(open_height(c, box)) + ";   // m"
                : "area            " + number_text(area) + ";   // m2")
      << "\n    }\n";
  return out.str();
}

std::string surface_name(const FoamCase& c, const ForceSurface& force) {
  if (force.of == ForceSurface::Of::side) return std::string(side_names[force.index]);
  if (force.of == ForceSurface::Of::moving_wall) return c.all_walls[force.index].name;
  return "obstacle." + std::to_string(force.index);
}

std::string force_patch(const FoamCase& c, const ForceSurface& force) {
  for (const Piston& piston : c.pistons)
    if (force.of == ForceSurface::Of::moving_wall &&
        piston.wall.name == c.all_walls[force.index].name)
      return side_name(c.flow, c.mesh, piston.side());
  const bool side = force.of == ForceSurface::Of::side;
  return side ? side_name(c.flow, c.mesh, force.index) : obstacle_name(force.index);
}

/// What a force is recorded as. A force that has no name of its own is called after the boundary.
std::string force_record(const FoamCase& c, const ForceSurface& force) {
  const std::string name =
      force.name == surface_name(c, force) ? force_patch(c, force) : word(force.name);
  return name + (name.starts_with("force") ? "" : "Force");
}

std::string force_text(const FoamCase& c, const ForceSurface& force) {
  const bool side = force.of == ForceSurface::Of::side;
  const std::string patch = force_patch(c, force), on = surface_name(c, force);
  const std::string name = force_record(c, force);
  std::ostringstream out;
  out << "\n    // postProcessing/" << name << ": force of water and air on "
      << (side ? "a side of the tank" : "an obstacle") << ", N, at every step"
      << (c.flow.dimension == 2 ? ",\n    // for the thickness of the mesh" : "") << ".\n    "
      << name
      << "\n    {\n        type            forces;\n        libs            (forces);\n"
         "        patches         ("
      << patch
      << ");\n        rho             rho;\n        CofR            (0 0 0);\n"
         "        log             no;\n        force           "
      << quoted_text(force.name) << ";   // its name in manifest.json\n        on              \""
      << on << "\";\n    }\n";
  return out.str();
}

}  // namespace

std::string instruments(const FoamCase& c) {
  std::string text;
  for (const Probe& probe : c.flow.probes) text += probe_text(c, probe);
  for (const Gauge& gauge : c.flow.gauges) text += gauge_text(c, gauge);
  for (const ForceSurface& force : c.flow.forces) text += force_text(c, force);
  return text;
}

void check_records(const FoamCase& c) {
  std::map<std::string, std::string> seen{{"waterVolume", "the case's own"},
                                          {"alphaRange", "the case's own"}};
  const auto add = [&](const std::string& record, const std::string& name) {
    const auto [other, is_new] = seen.emplace(record, '"' + name + '"');
    if (is_new) return;
    throw Error("name: found \"" + name + "\" and " + other->second +
                ", both recorded as postProcessing/" + record +
                ", expected names that differ in letters");
  };
  for (const Probe& probe : c.flow.probes) add(word(probe.name), probe.name);
  for (const Gauge& gauge : c.flow.gauges) add(word(gauge.name), gauge.name);
  for (const MovingWall& wall : c.flow.moving_walls) add(word(wall.name) + "Row", wall.name);
  for (const ForceSurface& force : c.flow.forces) {
    add(force_record(c, force), force.name);
    const std::string patch = force_patch(c, force);
    const bool there = std::any_of(c.boundaries.begin(), c.boundaries.end(),
                                   [&](const Patch& p) { return p.name == patch; });
    if (!there)
      throw Error("force: found " + surface_name(c, force) +
                  ", of which water reaches no part, expected a surface with water before it");
  }
}

std::string zone_actions(const std::string& zone, const Box& box) {
  return "    { name " + zone + "Set; type cellSet; action new; source boxToCell;\n      box " +
         vector_text(box.lower) + " " + vector_text(box.upper) + "; }\n    { name " + zone +
         "; type cellZoneSet; action new; source setToCellZone; set " + zone + "Set; }\n";
}

std::string topo_set(const FoamCase& c) {
  std::string actions;
  for (const Gauge& gauge : c.flow.gauges) actions += zone_actions(zone(gauge), column(c, gauge));
  actions += gate_zones(c);
  if (actions.empty()) return {};
  return header("dictionary", "topoSetDict") +
         "\n// Cells above and below each gauge; rows of cells that gates pass.\nactions\n(\n" +
         actions + ");\n";
}

}  // namespace surge::foam
