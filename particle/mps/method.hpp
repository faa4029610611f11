#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "particle/case/case_checks.hpp"
#include "particle/core/radial_function.hpp"
#include "particle/core/time_step.hpp"
#include "particle/kernel/mps_weight.hpp"
#include "particle/mps/laplacian.hpp"
#include "particle/mps/options.hpp"
#include "particle/mps/solver.hpp"

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
  static constexpr Supports supports{};

  static double interaction_radius(const Params& p) {
    return std::max(p.re_gradient, p.re_laplacian);
  }
  static int wall_layers(const Params& p) { return mps::wall_layers(p); }
  /// The step (s) that Solver::stable_step() takes when the fastest particle has this speed (m/s).
  static double step_limit(const Case& c, const Params& p, double speed) {
    const double nu = std::max(c.kinematic_viscosity, p.numerical_viscosity * c.spacing * speed);
    const double lambda = c.dimension == 2
                              ? laplacian_lambda<2>(Lambda::lattice, p.re_laplacian, c.spacing)
                              : laplacian_lambda<3>(Lambda::lattice, p.re_laplacian, c.spacing);
    return std::min(courant_step(c.time, c.spacing, speed),
                    viscous_step(0.25 / (c.dimension + 2), std::sqrt(lambda), nu));
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
