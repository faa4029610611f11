#pragma once

#include "particle/linear/pressure_solver.hpp"

namespace surge::mps {

/// What lambda of the Laplacian model, Eq. (7), is set to.
enum class Lambda {
  paper,     ///< re^2/12, as printed in Eq. (8)
  analytic,  ///< re^2/6 (2D), the value of the integrals in Eq. (8)
  lattice    ///< the sum over the initial lattice
};

using PpeSolver = linear::Solver;

enum class NegativePressure {
  keep,
  clip  ///< set to zero
};

/// Right side of the pressure equation.
enum class Source {
  number_density,         ///< Eq. (12)
  divergence_and_density  ///< mostly the velocity divergence (Tanaka & Masunaga 2010)
};

/// Model of the pressure gradient.
enum class GradientModel {
  minimum,     ///< Eqs. (5) and (6), the paper's
  conserving,  ///< conserves momentum (Khayyer & Gotoh 2008)
  corrected    ///< exact for linear fields (Khayyer & Gotoh 2011); `minimum` in spray
};

/// What the Laplacian of the pressure equation acts on.
enum class LaplacianOf {
  pressure,         ///< p, as in the paper
  dynamic_pressure  ///< p less what gravity makes of it between the two particles
};

/// Where the pressure of a free surface is zero.
enum class SurfaceAt {
  centre,       ///< in the centres of the surface particles, as in the paper
  half_spacing  ///< half a spacing, taken across the surface, outside of them
};

/// Whose pressures the equation of a wall particle takes its pressure from.
enum class WallCoupling {
  all,   ///< fluid and wall, and p = 0 by Eq. (14), as in the paper
  fluid  ///< the fluid it touches, always
};

/// Model of the viscous term.
enum class ViscousTerm {
  laplacian,   ///< nu lap v by Eq. (7), the original's (Koshizuka & Oka 1996)
  deformation  ///< by the rate of deformation, pairwise along the line between the particles
};

/// Which velocity particles are moved with.
enum class PositionUpdate {
  new_velocity,  ///< that at the end of the step, as in the paper
  mean_velocity  ///< the mean of both ends, second order in time (Cummins & Rudman 1999)
};

/// Choices of the MPS method. Lengths are in units of the particle spacing l0.
struct Params {
  double courant_factor =
      0.0;  ///< on the case's Courant number, with the limits of StepLimits; 0: Eq. (25) alone
  double re_gradient = 2.1;   ///< number density, gradient and free surface
  double re_laplacian = 4.0;  ///< Laplacian
  Lambda lambda = Lambda::paper;
  double beta = 0.97;           ///< Eq. (14): free surface where n < beta n0
  double surface_offset = 0.0;  ///< > 0: and neighbours lie to one side by more than this
  Source source = Source::number_density;
  double density_share = 0.01;   ///< gamma of Tanaka & Masunaga (2010)
  double divergence_time = 0.0;  ///< to take old divergence back, l0/reference speed; 0: a step
  LaplacianOf laplacian_of = LaplacianOf::pressure;
  SurfaceAt surface_at = SurfaceAt::centre;
  WallCoupling wall_coupling = WallCoupling::all;
  GradientModel gradient = GradientModel::minimum;
  double shifting = 0.0;  ///< share of l0 by which particles move apart while v_max moves by l0
  double numerical_viscosity = 0.0;  ///< nu is no less than this times l0 v_max
  ViscousTerm viscous_term = ViscousTerm::laplacian;
  double source_relaxation = 1.0;  ///< factor on the right side of Eq. (12)
  NegativePressure negative_pressure = NegativePressure::clip;
  PositionUpdate position_update = PositionUpdate::new_velocity;
  PpeSolver ppe_solver = PpeSolver::multigrid;
  double ppe_tolerance = 1e-6;  ///< relative residual
  int ppe_max_iterations = 2000;
  double collision_distance = 0.5;     ///< particles closer than this and approaching collide
  double collision_speed = 0.0;        ///< ... by at least this share of v_max
  double collision_restitution = 0.2;  ///< ratio of relative normal speeds after and before
  double wall_distance = 0.0;          ///< no centre comes closer to a solid surface than this
};

/// Layers of wall particles: the paper's three, of which the inner one carries pressure.
[[nodiscard]] constexpr int wall_layers(const Params&) {
  return 3;
}

}  // namespace surge::mps
