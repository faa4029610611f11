#include "foam_cases/pistons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "particle/case/enum_names.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

constexpr double samples = 2000.0;  ///< of a motion until the end, besides those of its law

std::size_t axis_of(const MovingWall& wall) {
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (std::abs(wall.direction[a]) > std::abs(wall.direction[axis])) axis = a;
  return axis;
}

/// Times at which a table of the motion has a row.
std::vector<double> table_times(const ScalarMotion& law, double end) {
  double step = end / samples;
  if (law.kind == ScalarMotion::Kind::harmonic) step = std::min(step, law.period / 400.0);
  std::vector<double> times;
  const double count = std::min(std::ceil(end / step), 500000.0) + 2.0;
  for (double k = 0.0; k <= count; ++k) times.push_back(k * step);
  const auto add = [&](double t) {
    if (t > 0.0 && t < end) times.push_back(t);
  };
  if (law.kind == ScalarMotion::Kind::table)
    for (const auto& sample : law.samples) add(sample[0]);
  add(law.start);
  if (law.kind == ScalarMotion::Kind::constant) add(law.stop);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Space before a face along its axis: to the nearest solid thing, m.
double way(const Case& c, std::size_t a, double face, bool water_above) {
  double end = water_above ? c.tank.box.upper[a] : c.tank.box.lower[a];
  const auto meet = [&](const Box& box) {
    if (water_above && box.lower[a] >= face) end = std::min(end, box.lower[a]);
    if (!water_above && box.upper[a] <= face) end = std::max(end, box.upper[a]);
  };
  for (const Box& box : c.obstacles) meet(box);
  for (const MovingWall& wall : c.moving_walls) meet(wall.box);
  return std::abs(end - face);
}

Piston piston_of(const Case& c, const MovingWall& wall) {
  const std::string name = "moving_wall: found the piston \"" + wall.name + "\" ";
  const std::size_t a = axis_of(wall);
  const double slack = 1e-9 * (c.tank.box.upper[a] - c.tank.box.lower[a]);
  std::size_t above = 0, below = 0;
  const auto count = [&](double lower, double upper) {
    if (lower >= wall.box.upper[a] - slack) ++above;
    if (upper <= wall.box.lower[a] + slack) ++below;
  };
  for (const FluidBlock& block : c.blocks) count(block.box.lower[a], block.box.upper[a]);
  for (const Box& box : c.obstacles) count(box.lower[a], box.upper[a]);
  for (const MovingWall& other : c.moving_walls)
    if (other.name != wall.name) count(other.box.lower[a], other.box.upper[a]);
  for (const Probe& probe : c.probes) count(probe.position[a], probe.position[a]);
  for (const Gauge& gauge : c.gauges) count(gauge.position[a], gauge.position[a]);
  if (above > 0 && below > 0)
    throw Error(name +
                "between water, obstacles or instruments, expected all of them on one side: "
                "the mesh has one");
  const double start = motion_at(wall.law, 0.0).displacement;
  if (std::abs(start) > 1e-9)
    throw Error(name + short_text(start) + " m out at time 0, expected a motion that starts at 0");
  Piston piston{wall, a, above > 0, 0.0};
  piston.tank_end = piston.water_above ? c.tank.box.lower[a] : c.tank.box.upper[a];
  const double face = piston.face();
  const double space = way(c, a, face, piston.water_above);
  for (const double t : table_times(wall.law, c.time.end)) {
    const double moved = motion_at(wall.law, t).displacement * wall.direction[a];
    const double forward = piston.water_above ? moved : -moved;
    if (forward < 0.9 * space) continue;
    throw Error(name + short_text(forward) + " m forward at " + short_text(t) +
                " s, expected at most 0.9 of the " + short_text(space) +
                " m to what stands before it");
  }
  return piston;
}

}  // namespace

bool is_piston(const Case& c, const MovingWall& wall) {
  const std::size_t axis = axis_of(wall);
  if (std::abs(wall.direction[axis]) < 1.0 - 1e-9 || c.tank.periodic[axis]) return false;
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a) {
    if (a == axis) continue;
    const double slack = 1e-9 * (c.tank.box.upper[a] - c.tank.box.lower[a]);
    double lower = c.tank.box.lower[a], upper = c.tank.box.upper[a];
    // On the side that gravity points away from it need not be higher than the water.
    for (const bool plus : {false, true}) {
      if (plus ? !(c.gravity[a] < 0.0) : !(c.gravity[a] > 0.0)) continue;
      double highest = plus ? lower : upper;
      for (const FluidBlock& block : c.blocks)
        highest =
            plus ? std::max(highest, block.box.upper[a]) : std::min(highest, block.box.lower[a]);
      (plus ? upper : lower) = highest;
    }
    if (wall.box.lower[a] > lower + slack || wall.box.upper[a] < upper - slack) return false;
  }
  return true;
}

std::vector<Piston> take_pistons(Case& c) {
  std::vector<Piston> pistons;
  for (const MovingWall& wall : c.moving_walls)
    if (is_piston(c, wall)) pistons.push_back(piston_of(c, wall));
  for (const Piston& piston : pistons) {
    (piston.water_above ? c.tank.box.lower : c.tank.box.upper)[piston.axis] = piston.face();
    std::erase_if(c.moving_walls,
                  [&](const MovingWall& wall) { return wall.name == piston.wall.name; });
  }
  return pistons;
}

std::string dynamic_mesh(const FoamCase& c) {
  if (c.pistons.empty()) return {};
  return header("dictionary", "dynamicMeshDict") +
         "\n// Pistons move a side of the mesh, and all cells with it.\n"
         "dynamicFvMesh       dynamicMotionSolverFvMesh;\nmotionSolverLibs    (fvMotionSolvers);\n"
         "solver              displacementLaplacian;\n\n"
         "displacementLaplacianCoeffs\n{\n    diffusivity     uniform;\n}\n";
}

std::string piston_file(const Piston& piston) {
  return "constant/" + word(piston.wall.name) + "Motion";
}

std::string point_displacement(const FoamCase& c) {
  if (c.pistons.empty()) return {};
  std::ostringstream out;
  out << header("pointVectorField", "pointDisplacement")
      << "\ndimensions      [0 1 0 0 0 0 0];\ninternalField   uniform (0 0 "
         "0);\n\nboundaryField\n{\n";
  for (const Patch& patch : c.boundaries) {
    out << "    " << patch.name << "\n    {\n";
    if (patch.kind == Patch::Kind::piston) {
      const auto piston = std::find_if(c.pistons.begin(), c.pistons.end(), [&](const Piston& p) {
        return side_name(c.flow, c.mesh, p.side()) == patch.name;
      });
      out << "        type        uniformFixedValue;\n        uniformValue tableFile;\n"
             "        uniformValueCoeffs { file \"<"
          << piston_file(*piston).insert(std::string("constant").size(), ">")
          << "\"; outOfBounds clamp; }\n        value       uniform (0 0 0);\n";
    } else if (patch.kind == Patch::Kind::empty) {
      out << "        type        empty;\n";
    } else if (patch.kind == Patch::Kind::periodic) {
      out << "        type        cyclic;\n";
    } else {
      // Sides along the way let their points glide; all else stays.
      bool glides = false;
      for (std::size_t side = 0; side < 2 * static_cast<std::size_t>(c.flow.dimension); ++side)
        for (const Piston& piston : c.pistons)
          glides =
              glides || (side / 2 != piston.axis && side_name(c.flow, c.mesh, side) == patch.name);
      out << (glides ? "        type        slip;\n"
                     : "        type        fixedValue;\n        value       uniform (0 0 0);\n");
    }
    out << "    }\n";
  }
  out << "}\n";
  return out.str();
}

std::string piston_table(const FoamCase& c, const Piston& piston) {
  std::string text = "(\n";
  for (const double t : table_times(piston.wall.law, c.flow.time.end)) {
    const double q = motion_at(piston.wall.law, t).displacement;
    Point moved = piston.wall.direction;
    for (double& component : moved) component *= q;
    text += "(" + number_text(t) + " " + vector_text(moved) + ")\n";
  }
  return text + ")\n";
}

}  // namespace surge::foam
