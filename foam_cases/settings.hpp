#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "particle/case/case.hpp"
#include "particle/support/toml.hpp"

namespace surge::foam {

/// The choices of a VOF computation that no case file makes: mesh, air, schemes, steps, running.
/// Names are those of system/caseParameters.
struct Settings {
  long cells_per_length = 20;
  double length = 0.0;        ///< L, m; 0: width of the first block
  double coarse_above = 8.0;  ///< L
  double density_air = 1.0;
  double viscosity_air = 0.0;
  double surface_tension = 0.0;
  double first_step = 0.0;    ///< s; 0: the case's
  double maximum_step = 0.0;  ///< s; 0: the case's
  double courant = 0.5;
  double alpha_courant = 0.5;
  std::string solver = "interFoam";
  std::string time_scheme = "Euler";
  std::string velocity_scheme = "linearUpwind grad(U)";
  std::string alpha_scheme = "vanLeer";
  double c_alpha = 1.0;
  long alpha_corrections = 2;
  long alpha_sub_cycles = 1;
  long pressure_corrections = 3;
  std::string momentum_predictor = "no";
  double pressure_tolerance = 1e-8;
  double pressure_relative_tolerance = 0.01;
  long processes = 1;
  std::string write_format = "binary";
  std::string write_compression = "off";
};

/// Calls entry(group, key, member, bounds, comment) for each of them, in the order of
/// system/caseParameters. `bounds` is for numbers; texts take what a dictionary takes as it is.
template <class S, class F>
void visit_settings(S&& s, F&& entry) {
  const Bounds positive = Bounds::above(0.0), not_negative = Bounds::at_least(0.0);
  const Bounds from_one = Bounds::closed(1, 1e6);
  entry("mesh", "cellsPerL", s.cells_per_length, from_one, "any whole number");
  entry("mesh", "L", s.length, not_negative, "m; 0: the width of the first block of water");
  entry("mesh", "coarseAbove", s.coarse_above, not_negative,
        "in L above the floor: cells grow from there to the top, if that is 2 L higher or more");
  entry("fluids", "rhoAir", s.density_air, positive, "kg/m3");
  entry("fluids", "nuAir", s.viscosity_air, not_negative, "m2/s; air at 20 C: 1.48e-5");
  entry("fluids", "sigma", s.surface_tension, not_negative, "N/m; water against air: 0.072");
  entry("time", "deltaT", s.first_step, not_negative, "s, first step");
  entry("time", "maxDeltaT", s.maximum_step, not_negative, "s");
  entry("time", "maxCo", s.courant, positive, "Courant number, all cells");
  entry("time", "maxAlphaCo", s.alpha_courant, positive, "Courant number, cells at the interface");
  entry("numerics", "solver", s.solver, Bounds{},
        "interFoam, or interIsoFoam: geometric advection (isoAdvector)");
  entry("numerics", "timeScheme", s.time_scheme, Bounds{}, "or: CrankNicolson 0.9");
  entry("numerics", "velocityScheme", s.velocity_scheme, Bounds{},
        "or: upwind, limitedLinearV 1, vanLeerV");
  entry("numerics", "alphaScheme", s.alpha_scheme, Bounds{},
        "interFoam only; or: MUSCL, vanAlbada, interfaceCompression");
  entry("numerics", "cAlpha", s.c_alpha, not_negative,
        "interFoam only; interface compression: 0 none, 1 usual");
  entry("numerics", "nAlphaCorr", s.alpha_corrections, from_one, "corrections of alpha in a step");
  entry("numerics", "nAlphaSubCycles", s.alpha_sub_cycles, from_one,
        "steps of alpha in a step of the flow");
  entry("numerics", "nCorrectors", s.pressure_corrections, from_one,
        "pressure corrections in a step");
  entry("numerics", "momentumPredictor", s.momentum_predictor, Bounds{}, "yes or no");
  entry("numerics", "pressureTolerance", s.pressure_tolerance, positive,
        "absolute residual of p_rgh in the last correction");
  entry("numerics", "pressureRelTol", s.pressure_relative_tolerance, Bounds::closed(0.0, 1.0),
        "of the residual in the other corrections; 0: mirrored cases agree to 1e-10");
  entry("running", "nProcs", s.processes, Bounds::closed(1, 65536),
        "processes; Allrun --np N overrides it");
  entry("running", "writeFormat", s.write_format, Bounds{}, "ascii or binary");
  entry("running", "writeCompression", s.write_compression, Bounds{},
        "on: only together with ascii");
}

/// A setting as people read it.
struct SettingText {
  std::string group, key, value, comment;
};
[[nodiscard]] std::vector<SettingText> setting_texts(const Settings& settings);

/// Settings from texts `key=value`; the others keep their values. `cells_per_length` and `length`
/// stand for cellsPerL and L. Throws Error for unknown keys, with a suggestion, and for what
/// belongs to the case.
[[nodiscard]] Settings read_settings(std::span<const std::string> assignments);

/// Settings in which all that the case decides is filled in: L and the steps.
[[nodiscard]] Settings resolved(Settings settings, const Case& c);

}  // namespace surge::foam
