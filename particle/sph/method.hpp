#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "particle/case/case_checks.hpp"
#include "particle/case/scales.hpp"
#include "particle/core/particle_count.hpp"
#include "particle/core/radial_function.hpp"
#include "particle/core/time_step.hpp"
#include "particle/sph/options.hpp"
#include "particle/sph/solver.hpp"
#include "particle/support/options.hpp"

namespace surge::sph {

/// SPH as the programs see it. particle/io/methods.hpp says what each entry is for.
struct Method {
  using Params = sph::Params;
  template <int D>
  using Solver = sph::Solver<D>;

  static constexpr std::string_view name = "sph";
  static constexpr std::string_view density_array = "density";
  static constexpr bool solves_pressure = false;
  static constexpr bool needs_reference_speed = true;  // its speed of sound is a multiple
  static constexpr Supports supports{.tank_motion = true, .moving_walls = true};

  static std::optional<OptionFault> fault(const Params&) { return std::nullopt; }
  static double interaction_radius(const Params& p) { return support_of(p.kernel) * p.h_over_l0; }
  static int wall_layers(const Params& p) { return sph::wall_layers(p); }
  /// The step (s) that Solver::stable_step() takes when the fastest particle has this speed (m/s).
  static double step_limit(const Case& c, const Params& p, double speed) {
    const double h = p.h_over_l0 * c.spacing;
    const double sound = p.sound_speed_ratio * reference_speed(c);
    double dt = courant_step(c.time, c.spacing, speed);
    if (p.acoustic_courant > 0.0) dt = std::min(dt, p.acoustic_courant * h / (sound + speed));
    const bool laplacian = p.viscous_term == ViscousTerm::laplacian;
    const double stiffness = laplacian ? 1.0 : c.dimension / (c.dimension + 2.0);
    return std::min(dt, viscous_step(0.125 * stiffness, h, c.kinematic_viscosity));
  }

  /// Bytes, fitted to measured runs: in 3D lists are longer.
  static double memory(const Params& p, int dimension, const ParticleCount& count) {
    const double lists = dimension == 3 ? 150.0 : 0.0;
    return (lists + (p.shifting == Shifting::none ? 400.0 : 600.0)) * count.all();
  }

  template <int D>
  static std::vector<RadialFunction> functions(const sph::Solver<D>& solver) {
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

}  // namespace surge::sph
