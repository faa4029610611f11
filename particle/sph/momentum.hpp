#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "particle/core/simd.hpp"

namespace surge::sph {

// Eq. (22)
/// Symmetric pressure term (Monaghan 1988, Comput. Phys. Commun. 48):
///   -(1/rho) grad p = -sum_j m_j (p_j/rho_j^2 + p_i/rho_i^2) grad_i W,  grad_i W = -slope (x_j -
///   x_i),
/// here the factor of (x_j - x_i) for one neighbour per unit of m_j. Pairs exchange equal and
/// opposite momentum.
template <class T>
T pressure_term(T p_over_rho2_i, T p_over_rho2_j, T slope) {
  return (p_over_rho2_i + p_over_rho2_j) * slope;
}

/// What stands for p_i/rho_i^2 in the pressure term on particle i where it is negative inside the
/// fluid: its opposite, which makes p_j + p_i into p_j - p_i (Sun, Colagrossi, Marrone, Antuono &
/// Zhang 2018, Comput. Phys. Commun. 224). Fluid under tension then exerts no force where its
/// pressure is uniform, however its particles lie, so that they don't clump (tensile instability).
/// What it exerts on j is judged by j: momentum isn't conserved pair by pair. The solver sets
/// negative pressures of surface particles themselves to zero, which the authors do not.
inline double without_tension(double p_over_rho2, bool near_surface) {
  return near_surface ? p_over_rho2 : std::abs(p_over_rho2);
}

/// What a bulk viscosity zeta = alpha c0 h (m2/s) adds to the pressure of a fluid whose density
/// grows at a rate (kg/m3/s):
///   -rho zeta div v = alpha c0 h D rho/Dt.
/// It damps sound, which the weakly compressible fluid has and water at this scale has not: a wave
/// of length lambda falls off as exp(-2 pi^2 alpha h / lambda) in each of its periods. Flow without
/// divergence doesn't feel it (the acoustic damper of Sun, Pilloton, Antuono & Colagrossi 2023, J.
/// Comput. Phys. 483, who add it to the acceleration).
inline double acoustic_damper(double alpha_c0_h, double density_rate) {
  return alpha_c0_h * density_rate;
}

/// Artificial viscosity of Monaghan (1992), Annu. Rev. Astron. Astrophys. 30, without its beta
/// term:
///   Pi_ij = -alpha c0 mu / rho,  mu = h v_ij . x_ij / (r^2 + 0.01 h^2), only where a pair
///   approaches.
/// Adds to p/rho^2 of the pair. `approach` is (v_j - v_i) . (x_j - x_i).
template <class T>
T artificial_viscosity(T approach, T r2, T mean_density, double alpha_c0_h, double h2) {
  using std::min;
  return T(-alpha_c0_h) * min(approach, T(0.0)) / ((r2 + T(0.01 * h2)) * mean_density);
}

/// What is needed of an artificial viscosity alpha c0 h (m2/s) where the fluid has a viscosity nu
/// (m2/s) of its own: it stands for alpha c0 h / (2 (D + 2)) (Monaghan 2005, Rep. Prog. Phys. 68),
/// and only what nu lacks of that is added, so that a viscous flow has the viscosity it is given.
template <int D>
double artificial_share(double alpha_c0_h, double nu) {
  return std::max(0.0, alpha_c0_h - 2.0 * (D + 2) * nu);
}

/// Laminar viscous acceleration of Morris, Fox & Zhu (1997), J. Comput. Phys. 136, for one
/// viscosity:
///   nu lap v = sum_j m_j (mu_i + mu_j) / (rho_i rho_j) (x_ij . grad_i W) / (r^2 + 0.01 h^2) v_ij,
/// here the factor of (v_j - v_i) for one neighbour.
template <class T>
T laminar_viscosity(T r2, T slope, T volume_j, double nu, double h2) {
  return T(-2.0 * nu) * slope * volume_j * r2 / (r2 + T(0.01 * h2));
}

/// Viscous acceleration of Monaghan & Gingold (1983), J. Comput. Phys. 52, for one viscosity:
///   nu (lap v + 2 grad div v) = 2 (D + 2) nu sum_j m_j/rho_j (v_ij . x_ij) / r^2 grad_i W,
/// here the factor of (x_j - x_i) for one neighbour. Pairs act along their line and so conserve
/// angular momentum. Summed over the fluid alone it dissipates 2 nu D:D, which holds at a free
/// surface too, unlike the one above (Colagrossi et al. 2011, Phys. Rev. E 84, 026705). On a square
/// lattice with h = 1.5 l0 shear along its axes feels 11 % too little, an error that goes away when
/// the lattice does. r2 > 0, m^2.
template <int D, class T>
T deformation_viscosity(T approach, T r2, T slope, T volume_j, double nu) {
  return T(-2.0 * (D + 2) * nu) * approach / r2 * slope * volume_j;
}

}  // namespace surge::sph
