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
/// here the contribution of one neighbour per unit of delta h c0. It smooths the pressure noise
/// that an equation of state turns density errors into; at second order in the spacing inside the
/// fluid.
template <class T>
T density_diffusion(T density_difference, T volume_j, T slope) {
  // (x_j - x_i) . grad_i W / r^2 = -slope
  return T(-2.0) * density_difference * slope * volume_j;
}

/// What hydrostatic equilibrium makes of a density difference: rho_j - rho_i of a fluid at rest
/// between two points whose potential g . (x_j - x_i) is `head` (m2/s2), for the equation of state
/// of Eq. (21). Fourtakas, Dominguez, Vacondio & Rogers (2019), Comput. Fluids 190: the density
/// diffusion acts on the rest only, so that it leaves still water still, at the surface and at
/// walls too, where its sum is one-sided. With dp = rho g dx and dp = c^2 drho,
///   rho_j - rho_i = rho head / c^2,  c^2 = c0^2 (rho/rho0)^(gamma-1) ~ c0^2 [1 +
///   (gamma-1)(rho/rho0 - 1)],
/// taken at the pair's mean density (the authors take it at rho0, which is off by the change of
/// c^2, 6 % where rho is 1 % off), and so equal and opposite for i and j.
template <class T>
T hydrostatic_difference(T head, T mean_density, double rho0, double c0, double gamma) {
  const T stiffening = T(1.0) + T(gamma - 1.0) * (mean_density * T(1.0 / rho0) - T(1.0));
  return mean_density * head / (T(c0 * c0) * stiffening);
}

}  // namespace surge::sph
