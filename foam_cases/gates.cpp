#include "foam_cases/gates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "foam_cases/laws.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

constexpr double least_slenderness = 3.0;
constexpr double most_rows = 400.0;
constexpr double samples = 20000.0;  ///< of the way of a gate, besides its time steps

/// Rate (1/s) at which cells of a gate stop the flow: water under 1 m of pressure over a gate of
/// 1 cm leaks at 1 mm/s.
constexpr const char* resistance = "1e6";

std::size_t axis_of(const MovingWall& wall) {
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (std::abs(wall.direction[a]) > std::abs(wall.direction[axis])) axis = a;
  return axis;
}

/// Faces of the rows along an axis: of cells, or of groups of cells where they are many.
std::vector<double> row_faces(const Mesh& mesh, std::size_t axis) {
  const double cells = mesh.cells_along(axis);
  const auto group = static_cast<long>(std::ceil(cells / most_rows));
  std::vector<double> faces{mesh.lower(axis)};
  double from = mesh.lower(axis);
  const double end = mesh.upper(axis) - 1e-6 * mesh.cell;
  for (long i = 1; from < end; ++i) {
    // The cell that begins here is the upper one of the two that share this face.
    from = mesh.cell_around(axis, from)[1];
    if (i % group == 0 || from >= end) faces.push_back(from);
  }
  return faces;
}

/// Times at which a gate holds a place along its axis: none, or from the first to the last of them.
GateRow stay(const FoamCase& c, const MovingWall& wall, std::size_t axis, double middle) {
  const double end = c.flow.time.end;
  const double step = std::min(c.settings.maximum_step, end / samples);
  const auto count = static_cast<long>(std::ceil(end / step));
  GateRow row;
  bool inside = false, seen = false;
  for (long k = 0; k <= count; ++k) {
    const double time = std::min(static_cast<double>(k) * step, end);
    const double moved = motion_at(wall.law, time).displacement * wall.direction[axis];
    const double x = middle - moved;
    const bool now = x > wall.box.lower[axis] && x < wall.box.upper[axis];
    if (now == inside) continue;
    if (now && seen) {
      throw Error("moving_wall: found \"" + wall.name + "\" back at " + short_text(middle) +
                  " m, which it had left, expected a gate that passes each place once");
    }
    (now ? row.from : row.until) = time;
    seen = seen || now;
    inside = now;
  }
  if (inside) row.until = 2.0 * end;
  return row;
}

}  // namespace

std::string gate_fault(const Case& c, const MovingWall& wall) {
  const std::size_t axis = axis_of(wall);
  if (std::abs(wall.direction[axis]) < 1.0 - 1e-9) return "a wall that moves across the axes";
  double thinnest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
    if (a != axis) thinnest = std::min(thinnest, wall.box.upper[a] - wall.box.lower[a]);
  const double along = wall.box.upper[axis] - wall.box.lower[axis];
  if (along >= least_slenderness * thinnest) return {};
  return "a wall " + short_text(along) + " m long in its direction and " + short_text(thinnest) +
         " m thick, which pushes water";
}

std::vector<GateRow> gate_rows(const FoamCase& c, const MovingWall& wall) {
  const std::size_t axis = axis_of(wall);
  const std::vector<double> faces = row_faces(c.mesh, axis);
  std::vector<GateRow> rows;
  for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
    GateRow row = stay(c, wall, axis, 0.5 * (faces[k] + faces[k + 1]));
    if (!(row.until > row.from)) continue;
    row.zone = word(wall.name) + "Row" + std::to_string(rows.size());
    row.box = in_three_dimensions(c.flow, c.mesh, wall.box);
    row.box.lower[axis] = faces[k];
    row.box.upper[axis] = faces[k + 1];
    rows.push_back(row);
  }
  return rows;
}

std::string gate_zones(const FoamCase& c) {
  std::string text;
  for (const MovingWall& wall : c.flow.moving_walls)
    for (const GateRow& row : gate_rows(c, wall)) text += zone_actions(row.zone, row.box);
  return text;
}

std::string gate_options(const FoamCase& c) {
  std::ostringstream out;
  for (const MovingWall& wall : c.flow.moving_walls) {
    out << "\n// " << comment(wall.name)
        << ": cells resist the flow while the gate is there, row by row. It neither pushes nor "
           "drags.\n";
    for (const GateRow& row : gate_rows(c, wall)) {
      out << row.zone
          << "\n{\n    type            explicitPorositySource;\n    active          yes;\n"
          << "    explicitPorositySourceCoeffs\n    {\n        timeStart       "
          << number_text(row.from) << ";\n        duration        "
          << number_text(row.until - row.from)
          << ";   // s\n        selectionMode   cellZone;\n        cellZone        " << row.zone
          << ";\n        type            fixedCoeff;\n        alpha           (" << resistance
          << ' ' << resistance << ' ' << resistance
          << ");   // 1/s\n        beta            (0 0 0);\n        rhoRef          $rhoWater;\n"
             "        coordinateSystem { origin (0 0 0); e1 (1 0 0); e2 (0 1 0); }\n    }\n}\n";
    }
  }
  return out.str();
}

std::string moving_walls(const FoamCase& c) {
  if (c.all_walls.empty()) return {};
  std::ostringstream out;
  out << header("dictionary", "movingWalls")
      << "\n// What the case says of walls that move; fvOptions was made from it. For "
         "manifest.json.\n";
  for (std::size_t i = 0; i < c.all_walls.size(); ++i) {
    const MovingWall& wall = c.all_walls[i];
    out << "wall" << i << "\n{\n";
    write_entry(out, "name", quoted_text(wall.name));
    write_entry(out, "lower", vector_text(wall.box.lower));
    write_entry(out, "upper", vector_text(wall.box.upper));
    write_entry(out, "direction", vector_text(wall.direction));
    write_law(out, wall.law);
    for (const Piston& piston : c.pistons) {
      if (piston.wall.name != wall.name) continue;
      write_entry(out, "tankSide", std::string(side_names[piston.side()]));
      write_entry(out, "tankEnd", number_text(piston.tank_end));
    }
    out << "}\n";
  }
  return out.str();
}

}  // namespace surge::foam
