#pragma once

#include <array>

namespace surge::sph {

// Eq. (20)
/// Rate of change of density by the continuity equation, D rho_i/Dt = sum_j m_j v_ij . grad_i W_ij:
/// the contribution of one neighbour per unit of m_j, with
/// dv = v_j - v_i, dx = x_j - x_i and slope = (dW/dr) / r, so that grad_i W = -slope dx.
template <class T, std::size_t D>
T continuity(const std::array<T, D>& dv, const std::array<T, D>& dx, T slope) {
  T dot = dv[0] * dx[0];
  for (std::size_t a = 1; a < D; ++a) dot += dv[a] * dx[a];
  return dot * slope;
}

/// Density diffusion of Molteni & Colagrossi (2009), Comput. Phys. Commun. 180:
///   D rho_i/Dt += delta h c0 sum_j 2 (rho_j - rho_i) (x_j - x_i) . grad_i W / r^2 m_j/rho_j,
/// here the contribution of one neighbour per unit of delta h c0. It smooths the pressure noise that
/// an equation of state turns density errors into; at second order in the spacing inside the fluid.
template <class T>
T density_diffusion(T density_difference, T volume_j, T slope) {
  // (x_j - x_i) . grad_i W / r^2 = -slope
  return T(-2.0) * density_difference * slope * volume_j;
}

}  // namespace surge::sph
