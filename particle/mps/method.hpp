#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "particle/case/case_checks.hpp"
#include "particle/core/particle_count.hpp"
#include "particle/core/radial_function.hpp"
#include "particle/kernel/mps_weight.hpp"
#include "particle/mps/options.hpp"
#include "particle/mps/solver.hpp"
#include "particle/mps/stability.hpp"
#include "particle/support/options.hpp"

namespace surge::mps {

/// MPS as the programs see it. particle/io/methods.hpp says what each entry is for.
struct Method {
  using Params = mps::Params;
  template <int D>
  using Solver = mps::Solver<D>;

  static constexpr std::string_view name = "mps";
  static constexpr std::string_view density_array = "number_density";
  static constexpr bool solves_pressure = true;
  static constexpr bool needs_reference_speed = false;
  static constexpr Supports supports{.tank_motion = true, .moving_walls = true};

  /// What is wrong with the options together; they are good where it is empty.
  static std::optional<OptionFault> fault(const Params& p) {
    if (p.re_gradient <= p.re_laplacian) return std::nullopt;
    return OptionFault{"re_gradient", number_text(p.re_gradient),
                       "at most re_laplacian = " + number_text(p.re_laplacian)};
  }
  static double interaction_radius(const Params& p) {
    return std::max(p.re_gradient, p.re_laplacian);
  }
  static int wall_layers(const Params& p) { return mps::wall_layers(p); }
  /// The step (s) that Solver::stable_step() takes when the fastest particle has this speed (m/s).
  static double step_limit(const Case& c, const Params& p, double speed) {
    double gravity = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
      if (!c.has_tank || !c.tank.periodic[a]) gravity += c.gravity[a] * c.gravity[a];
    return StepLimits(c, p)(speed, std::sqrt(gravity));
  }

  /// Bytes, fitted to measured runs: what each particle holds, and the neighbour list and pressure
  /// equation of those that have a pressure, for which some solvers make a second matrix. A direct
  /// solver fills more than that.
  static double memory(const Params& p, int dimension, const ParticleCount& count) {
    const double r = p.re_laplacian;
    const double neighbours = std::numbers::pi * r * r * (dimension == 2 ? 1.0 : 4.0 / 3.0 * r);
    const double per_neighbour = p.ppe_solver == PpeSolver::multigrid ? 16.0 : 34.0;
    const double pressures = count.fluid + count.wall / mps::wall_layers(p);
    return 500.0 * count.all() + per_neighbour * neighbours * pressures;
  }

  template <int D>
  static std::vector<RadialFunction> functions(const mps::Solver<D>& solver) {
    const auto weight = [](const char* name, double re) {
      return RadialFunction{name, "1", re, false, [re](double r) { return mps_weight(r, re); }};
    };
    return {weight("w", solver.radius()), weight("w_laplacian", solver.laplacian_radius())};
  }
};

}  // namespace surge::mps
