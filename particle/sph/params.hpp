#pragma once

#include <cmath>

namespace surge::sph {

enum class Kernel { quintic_spline, wendland_c2 };

enum class NegativePressure {
  keep,
  clip,       ///< set to zero
  difference  ///< inside the fluid it acts by p_j - p_i (Sun et al. 2018), on the surface it is
              ///< zero
};
/// Whether particles are moved relative to the fluid so that they stay evenly spread.
enum class Shifting {
  none,
  concentration  ///< down the gradient of their concentration (Sun et al. 2017)
};

/// How wall particles get their density, and by the equation of state their pressure.
enum class WallDensity {
  reference,    ///< stays at rho0: walls do not push by pressure, only through the fluid's own p_i
  continuity,   ///< Eq. (20) holds for wall particles too (Dalrymple & Knio 2001)
  extrapolated  ///< pressure from the fluid nearby, with gravity (Adami, Hu & Adams 2012)
};

/// What the density diffusion acts on.
enum class DiffusionOf {
  density,         ///< the whole density (Molteni & Colagrossi 2009)
  dynamic_density  ///< the density less its hydrostatic part (Fourtakas et al. 2019)
};

/// Model of the laminar viscous term.
enum class ViscousTerm {
  laplacian,   ///< Morris, Fox & Zhu (1997)
  deformation  ///< Monaghan & Gingold (1983): right at a free surface too (Colagrossi et al. 2011)
};

/// Choices of the SPH method.
struct Params {
  Kernel kernel = Kernel::quintic_spline;
  double h_over_l0 = 1.2;           ///< smoothing length over spacing
  double sound_speed_ratio = 10.0;  ///< c0 over the reference speed max(sqrt(2 g H), initial speed)
  double gamma = 7.0;               ///< exponent of the equation of state, Eq. (21)
  double xsph_epsilon = 0.5;        ///< Eq. (24)
  double acoustic_courant =
      0.0;  ///< dt <= this * h / (c0 + v_max); 0: only Eq. (25) limits the step
  NegativePressure negative_pressure = NegativePressure::keep;
  ViscousTerm viscous_term = ViscousTerm::laplacian;
  double artificial_viscosity = 0.0;  ///< alpha of Monaghan (1992)
  double density_diffusion = 0.0;     ///< delta of Molteni & Colagrossi (2009)
  DiffusionOf diffusion_of = DiffusionOf::density;
  double acoustic_damping = 0.0;  ///< bulk viscosity over c0 h (Sun et al. 2023)
  WallDensity wall_density = WallDensity::continuity;
  Shifting shifting = Shifting::none;
  double survey_interval = 0.0;   ///< of surface and shift, h/speed of the flow; 0: every step
  double wall_distance = 0.25;    ///< in l0: no particle's centre comes closer to a wall
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

}  // namespace surge::sph
