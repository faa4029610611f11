#include "foam_cases/foam_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "foam_cases/gates.hpp"
#include "foam_cases/pistons.hpp"
#include "foam_cases/size.hpp"
#include "foam_cases/surfaces.hpp"
#include "particle/case/case_checks.hpp"
#include "particle/case/case_file.hpp"
#include "particle/case/case_keys.hpp"
#include "particle/case/scales.hpp"
#include "particle/support/spelling.hpp"

namespace surge::foam {

namespace {

/// Top-level names of a case file, as read_case() takes them.
std::vector<std::string> case_tables() {
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys()) {
    std::string name(key.table.empty() ? key.key : key.table);
    std::erase_if(name, [](char c) { return c == '[' || c == ']'; });
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

/// Asks for all entries of a table that says how another program computes the case.
void leave(const TomlTable& table) {
  for (const std::string& key : table.keys()) static_cast<void>(table.has(key));
}

/// Tables of other programs: `method` and those that methods have. A name that looks like a table
/// of the case is a misspelling.
void leave_methods(const TomlTable& root, std::span<const std::string> overrides) {
  const std::vector<std::string> own = case_tables();
  for (const std::string& key : root.keys()) {
    if (std::find(own.begin(), own.end(), key) != own.end()) continue;
    if (!nearest(key, own).empty()) continue;  // finish() will name it
    leave(root.table(key));
    for (const std::string& override : overrides) {
      if (override.starts_with(key + "."))
        throw Error("--set " + override +
                    ": found a table that interFoam does not read, expected "
                    "an entry of the case, or --foam key=value");
    }
  }
}

/// Whether boxes of water, which do not overlap, fill the tank up to its obstacles.
bool is_full(const Case& c) {
  const auto volume = [&](const Box& box) {
    double product = 1.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
      product *= box.upper[a] - box.lower[a];
    return product;
  };
  double air = volume(c.tank.box);
  for (const FluidBlock& block : c.blocks)
    if (block.shape == FluidBlock::Shape::box) air -= volume(block.box);
  for (const Obstacle& obstacle : c.obstacles) {
    if (!obstacle.surface) {
      air -= volume(obstacle);
      continue;
    }
    air -= obstacle.surface->volume();
    for (const FluidBlock& block : c.blocks)  // whose water it takes the place of
      if (block.shape == FluidBlock::Shape::box)
        air += volume(block.box) * obstacle.surface->share_of(block.box);
  }
  if (has_surfaces(c)) return std::abs(air) <= 1e-3 * volume(c.tank.box);
  return std::abs(air) <= 1e-9 * volume(c.tank.box);
}

/// What VOF on a mesh of boxes does not compute.
void check_supported(const Case& c, const TomlTable& root) {
  if (!c.has_tank)
    throw root.error("tank", "no tank",
                     "a [tank] (a mesh ends somewhere), with open sides perhaps");
  for (std::size_t i = 0; i < c.moving_walls.size(); ++i) {
    if (is_piston(c, c.moving_walls[i])) continue;
    const std::string fault = gate_fault(c, c.moving_walls[i]);
    if (fault.empty()) continue;
    throw root.tables("moving_wall")[i].error("direction", fault,
                                              "a gate (along an axis, at least 3 times as long in "
                                              "its direction as thick) or a piston (along "
                                              "an axis, filling the tank across it from floor to "
                                              "above the water); a tank that moves as a "
                                              "whole is [motion]");
  }
  for (std::size_t i = 0; i < c.forces.size(); ++i) {
    if (c.forces[i].of == ForceSurface::Of::moving_wall &&
        !is_piston(c, c.moving_walls[c.forces[i].index]))
      throw root.tables("force")[i].error("on", "a gate, of which the mesh has no surface",
                                          "a side, an obstacle or a piston");
  }
  for (std::size_t a = 0; a < 3; ++a) {
    if (c.gravity[a] == 0.0 || !c.tank.periodic[a] || is_full(c)) continue;
    throw root.table("fluid").error("gravity",
                                    number_text(c.gravity[a]) + " m/s2 along a periodic axis",
                                    "none, or a tank full of water: p_rgh = p - rho g h is not "
                                    "periodic there, and the force that "
                                    "drives the flow instead has one density");
  }
  const bool turns = c.motion.kind == TankMotion::Kind::rotation;
  for (std::size_t a = 0; a < 3 && c.motion.kind != TankMotion::Kind::none; ++a) {
    const bool along = std::abs(c.motion.direction[a]) > 0.0;
    if (c.tank.periodic[a] && (turns || along))
      throw root.table("motion").error("kind", "a motion on a periodic axis", "walls on that axis");
  }
  for (std::size_t i = 0; i < c.gauges.size(); ++i) {
    const double g = length(c.gravity);
    const bool aligned = std::any_of(c.gravity.begin(), c.gravity.end(), [&](double component) {
      return std::abs(component) > 0.999999 * g;
    });
    if (!aligned)
      throw root.tables("gauge")[i].error("position", "a gauge under oblique gravity",
                                          "gravity along an axis of the mesh");
  }
}

/// Whether a place is on floor or ceiling and less than a cell from a wall across it.
bool in_edge(const FoamCase& c, const Probe& probe) {
  const auto distance = [&](std::size_t a) {
    return std::min(probe.position[a] - c.mesh.lower(a), c.mesh.upper(a) - probe.position[a]);
  };
  if (distance(c.mesh.up) > 1e-6 * c.mesh.cell) return false;
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a)
    if (a != c.mesh.up && !c.flow.tank.periodic[a] && distance(a) < 0.999999 * c.mesh.cell)
      return true;
  return false;
}

FoamCase checked(const TomlTable& root, const std::string& source,
                 std::span<const std::string> overrides, std::span<const std::string> settings) {
  FoamCase made;
  made.source = source;
  made.flow = read_case(root);
  leave_methods(root, overrides);
  root.finish();
  check_case(made.flow, root);
  check_supported(made.flow, root);
  const Point still = still_gravity(made.flow);
  for (std::size_t a = 0; a < 3; ++a) made.drive[a] = made.flow.gravity[a] - still[a];
  made.flow.gravity = still;
  made.all_walls = made.flow.moving_walls;
  made.pistons = take_pistons(made.flow);
  made.settings = resolved(read_settings(settings), made.flow);
  made.mesh = make_mesh(made.flow, made.settings);
  check_connected(made.flow, made.mesh);
  made.boundaries = patches(made.flow, made.mesh, Vertices(made.mesh));
  for (const Piston& piston : made.pistons)
    for (Patch& patch : made.boundaries)
      if (patch.name == side_name(made.flow, made.mesh, piston.side()))
        patch.kind = Patch::Kind::piston;
  check_records(made);
  for (const MovingWall& wall : made.flow.moving_walls) static_cast<void>(gate_rows(made, wall));
  check_size(case_size(made), available_memory());
  return made;
}

}  // namespace

FoamCase read_foam_case(const std::filesystem::path& file, std::span<const std::string> overrides,
                        std::span<const std::string> settings) {
  return checked(TomlTable::read(file, overrides), file.filename().string(), overrides, settings);
}

FoamCase parse_foam_case(std::string_view text, const std::string& source,
                         std::span<const std::string> overrides,
                         std::span<const std::string> settings) {
  return checked(TomlTable::parse(text, source, overrides), source, overrides, settings);
}

std::vector<std::string> notes_on(const FoamCase& c) {
  std::vector<std::string> notes = motion_notes(c);
  for (const Probe& probe : c.flow.probes) {
    if (probe.diameter > 0.0)
      notes.push_back("probe \"" + probe.name +
                      "\": the pressure at its middle is recorded, not the "
                      "mean over its diameter");
  }
  for (const MovingWall& wall : c.flow.moving_walls) {
    notes.push_back(
        "moving wall \"" + wall.name + "\": " + std::to_string(gate_rows(c, wall).size()) +
        " rows of cells stop the flow while it is there; it neither pushes nor drags water");
  }
  for (const Piston& piston : c.pistons) {
    notes.push_back(
        "piston \"" + piston.wall.name +
        "\": a side of the mesh, as high as the tank; what is behind it is not computed, and "
        "all cells move with it, those of gauges too");
  }
  const double frames = c.flow.time.end / c.flow.output_interval;
  if (std::abs(frames - std::round(frames)) > 1e-6) {
    notes.push_back(
        "time.end is no multiple of output.interval: OpenFOAM writes its last frame at " +
        short_text(std::floor(frames) * c.flow.output_interval) + " s");
  }
  for (const Probe& probe : c.flow.probes) {
    if (!in_edge(c, probe)) continue;
    notes.push_back(
        "probe \"" + probe.name +
        "\": it lies where floor and wall meet, where OpenFOAM records a mean over faces "
        "half a cell apart; a cell, " +
        short_text(c.mesh.cell) + " m, from the wall it is exact");
  }
  if (has_surfaces(c.flow))
    notes.push_back(
        "obstacles with a surface: cells whose middles they hold are cut out, so that their faces "
        "are steps of a cell, " +
        short_text(c.mesh.cell) + " m; manifest.json has the volume that the mesh leaves out");
  for (const Probe& probe : c.flow.probes) {
    if (!is_cut(c, probe.position)) continue;
    notes.push_back(
        "probe \"" + probe.name +
        "\": its cell is cut out; the pressure in the middle of the nearest cell of the "
        "mesh is recorded");
  }
  for (const FluidBlock& block : c.flow.blocks) {
    if (block.shape == FluidBlock::Shape::box) continue;
    const double cells = (block.box.upper[0] - block.box.lower[0]) / c.mesh.cell;
    notes.push_back(
        "a ball " + number_text(std::round(cells * 10.0) / 10.0) +
        " cells wide is filled by whole cells; manifest.json has its volume in the mesh");
  }
  return notes;
}

}  // namespace surge::foam
