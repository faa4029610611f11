#pragma once

#include <cmath>

#include "particle/linear/pressure_solver.hpp"

namespace surge::isph {

enum class Kernel { wendland_c2, quintic_spline };

/// Where the pressure of a free surface is zero.
enum class SurfaceAt {
  centre,       ///< in the centres of the surface particles
  half_spacing  ///< half a spacing outside of them
};

using PpeSolver = linear::Solver;

/// Choices of the ISPH method. Lengths are in units of the particle spacing l0.
struct Params {
  Kernel kernel = Kernel::wendland_c2;
  double h_over_l0 = 1.5;        ///< smoothing length over spacing
  double surface_lambda = 0.75;  ///< free surface where lambda is below this, see Surface
  SurfaceAt surface_at = SurfaceAt::half_spacing;
  double divergence_time = 0.0;      ///< to take old divergence back, l0/reference speed; 0: a step
  double shifting = 2.0;             ///< A of Skillen et al. (2013); 0: off
  double numerical_viscosity = 0.0;  ///< nu is no less than this times l0 v_max
  PpeSolver ppe_solver = PpeSolver::multigrid;
  double ppe_tolerance = 1e-6;  ///< relative residual
  int ppe_max_iterations = 2000;
  double wall_distance = 0.25;    ///< no centre comes closer to a solid surface than this
  double wall_restitution = 0.0;  ///< ratio of normal speeds after and before a wall collision
};

/// How far a kernel reaches, in h.
[[nodiscard]] constexpr double support_of(Kernel kernel) {
  return kernel == Kernel::wendland_c2 ? 2.0 : 3.0;
}

/// Layers of wall particles that fill the kernel of a particle at the wall.
[[nodiscard]] inline int wall_layers(const Params& params) {
  return static_cast<int>(std::ceil(support_of(params.kernel) * params.h_over_l0 - 1e-9));
}

}  // namespace surge::isph
