#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "particle/case/case_checks.hpp"
#include "particle/core/particle_count.hpp"
#include "particle/core/radial_function.hpp"
#include "particle/core/time_step.hpp"
#include "particle/isph/options.hpp"
#include "particle/isph/solver.hpp"
#include "particle/support/options.hpp"

namespace surge::isph {

/// Incompressible SPH as the programs see it. particle/io/methods.hpp says what each entry is for.
struct Method {
  using Params = isph::Params;
  template <int D>
  using Solver = isph::Solver<D>;

  static constexpr std::string_view name = "isph";
  static constexpr std::string_view density_array = "lambda";
  static constexpr bool solves_pressure = true;
  static constexpr bool needs_reference_speed = false;
  static constexpr Supports supports{.tank_motion = true, .moving_walls = true};

  static std::optional<OptionFault> fault(const Params&) { return std::nullopt; }
  static double interaction_radius(const Params& p) { return support_of(p.kernel) * p.h_over_l0; }
  static int wall_layers(const Params& p) { return isph::wall_layers(p); }
  /// The step (s) that Solver::stable_step() takes when the fastest particle has this speed (m/s).
  static double step_limit(const Case& c, const Params& p, double speed) {
    const double nu = std::max(c.kinematic_viscosity, p.numerical_viscosity * c.spacing * speed);
    const double stiffness = c.dimension / (c.dimension + 2.0);
    return std::min(courant_step(c.time, c.spacing, speed),
                    viscous_step(0.125 * stiffness, p.h_over_l0 * c.spacing, nu));
  }

  /// Bytes, as for MPS: fields, neighbour list and pressure equation.
  static double memory(const Params& p, int dimension, const ParticleCount& count) {
    const double r = interaction_radius(p);
    const double neighbours = std::numbers::pi * r * r * (dimension == 2 ? 1.0 : 4.0 / 3.0 * r);
    const double per_neighbour = p.ppe_solver == PpeSolver::multigrid ? 16.0 : 34.0;
    return 500.0 * count.all() + per_neighbour * neighbours * count.all();
  }

  template <int D>
  static std::vector<RadialFunction> functions(const isph::Solver<D>& solver) {
    return std::visit(
        [&](const auto& kernel) -> std::vector<RadialFunction> {
          const double support = kernel.support * solver.smoothing_length();
          return {{"W", "1/m" + std::to_string(D), support, true,
                   [kernel](double r) { return kernel.value(r); }},
                  {"dW/dr", "1/m" + std::to_string(D + 1), support, true,
                   [kernel](double r) { return kernel.derivative(r); }}};
        },
        solver.kernel());
  }
};

}  // namespace surge::isph
