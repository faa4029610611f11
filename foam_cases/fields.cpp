#include <algorithm>
#include <utility>

#include "foam_cases/case_files.hpp"

namespace surge::foam {

namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

std::string boundary(const std::string& name, const Entries& entries) {
  std::string text = "    " + name + "\n    {\n";
  for (const auto& [key, value] : entries)
    text += "        " + key + std::string(12 - std::min<std::size_t>(key.size(), 11), ' ') +
            value + ";\n";
  return text + "    }\n";
}

/// One entry for all walls, then one for each other boundary.
template <class Open>
std::string boundaries(const FoamCase& c, const Entries& wall, const Entries& piston, Open&& open) {
  std::vector<std::string> walls;
  for (const Patch& patch : c.boundaries)
    if (patch.kind == Patch::Kind::wall) walls.push_back(patch.name);
  std::string names;
  for (const std::string& name : walls) names += (names.empty() ? "" : "|") + name;
  if (walls.size() > 1) names = "\"(" + names + ")\"";
  std::string text;
  if (!walls.empty()) text = boundary(names, wall);
  for (const Patch& patch : c.boundaries) {
    if (patch.kind == Patch::Kind::piston) text += boundary(patch.name, piston);
    if (patch.kind == Patch::Kind::open) text += boundary(patch.name, open(patch));
    if (patch.kind == Patch::Kind::periodic) text += boundary(patch.name, {{"type", "cyclic"}});
    if (patch.kind == Patch::Kind::empty) text += boundary(patch.name, {{"type", "empty"}});
  }
  return text;
}

}  // namespace

std::string velocity_boundaries(const FoamCase& c) {
  return boundaries(
      c, {{"type", "$wall"}}, {{"type", "movingWallVelocity"}, {"value", "uniform (0 0 0)"}},
      [](const Patch&) {
        return Entries{{"type", "pressureInletOutletVelocity"}, {"value", "uniform (0 0 0)"}};
      });
}

std::string alpha_boundaries(const FoamCase& c) {
  return boundaries(c, {{"type", "zeroGradient"}}, {{"type", "zeroGradient"}}, [](const Patch&) {
    return Entries{{"type", "inletOutlet"}, {"inletValue", "uniform 0"}, {"value", "uniform 0"}};
  });
}

namespace {

bool has_open_side(const FoamCase& c) {
  return std::any_of(c.boundaries.begin(), c.boundaries.end(),
                     [](const Patch& patch) { return patch.kind == Patch::Kind::open; });
}

/// fixedFluxPressure knows of gravity and not of other forces on the cells at a wall; the other one
/// takes all of them from the cell. A tank without an open side cannot have it: the solver adjusts
/// the flux through such walls before it is set to zero.
const char* wall_pressure(const FoamCase& c) {
  const bool turns = c.flow.motion.kind == TankMotion::Kind::rotation;
  return turns && has_open_side(c) ? "fixedFluxExtrapolatedPressure" : "fixedFluxPressure";
}

}  // namespace

// Where gravity points away from, all is air and p_rgh uniform. On the other sides the air outside
// is at rest, p = rhoAir gh, so that p_rgh = p - rho gh depends on what is there; what flows in has
// lost its dynamic pressure.
std::string pressure_boundaries(const FoamCase& c) {
  const Entries wall{{"type", wall_pressure(c)}, {"value", "uniform 0"}};
  return boundaries(c, wall, wall, [](const Patch& patch) {
    if (patch.name == "atmosphere") return Entries{{"type", "totalPressure"}, {"p0", "uniform 0"}};
    return Entries{{"type", "exprFixedValue"},
                   {"value", "uniform 0"},
                   {"valueExpr", "\"($rhoAir - rho)*gh - (phi < 0 ? 0.5 : 0)*rho*magSqr(U)\""}};
  });
}

}  // namespace surge::foam
