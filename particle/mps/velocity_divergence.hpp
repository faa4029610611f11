#pragma once

#include <optional>

#include "particle/mps/gradient.hpp"
#include "particle/mps/number_density.hpp"

namespace surge::mps {

/// Velocity divergence by the gradient model of Eq. (5), 1/s:
///   <div v>_i = d/n0 sum_{j != i} (v_j - v_i) . (x_j - x_i) / |x_j - x_i|^2 w(|x_j - x_i|).
/// re in m; relative(j) = v_j - v_i in m/s. The flux that all particles on one side of a plane see
/// through it is the one that the Laplacian model balances. Exact for linear fields on a lattice
/// only: where the lattice is stretched, the shear of the flow passes for divergence.
template <int D, class Relative, class Counts>
double velocity_divergence(std::size_t i, std::span<const std::uint32_t> neighbours,
                           const Displacement<D>& displacement, double re, double n0,
                           Relative&& relative, Counts&& counts) {
  double sum = 0.0;
  for_each_within<D>(i, neighbours, displacement, re, counts,
                     [&](std::size_t j, const Vec<D>& d, double r2) {
                       const Vec<D> v = relative(j);
                       double approach = 0.0;
                       for (int a = 0; a < D; ++a) approach += v[a] * d[a];
                       sum += approach / r2 * mps_weight(std::sqrt(r2), re);
                     });
  return D / n0 * sum;
}

/// The velocity gradient by the corrected gradient model (Khayyer & Gotoh 2011), 1/s, row a being
/// the gradient of v_a:
///   [ sum (v_j - v_i) (x_j - x_i)^T / r^2 w ] C_i,
/// exact for linear fields wherever the neighbours are. Empty where they are too few for C, see
/// corrected_gradient().
template <int D, class Relative, class Counts>
std::optional<std::array<Vec<D>, D>> velocity_gradient(std::size_t i,
                                                       std::span<const std::uint32_t> neighbours,
                                                       const Displacement<D>& displacement,
                                                       double re, double n0, double limit,
                                                       Relative&& relative, Counts&& counts) {
  std::array<Vec<D>, D> moment{};
  std::array<Vec<D>, D> sum{};  // one row per component of v
  for_each_within<D>(i, neighbours, displacement, re, counts,
                     [&](std::size_t j, const Vec<D>& d, double r2) {
                       const double weight = mps_weight(std::sqrt(r2), re) / r2;
                       const Vec<D> v = relative(j);
                       for (int a = 0; a < D; ++a)
                         for (int b = 0; b < D; ++b) {
                           moment[a][b] += weight * d[a] * d[b];
                           sum[a][b] += weight * v[a] * d[b];
                         }
                     });
  for (int a = 0; a < D; ++a) {
    const auto gradient = solve_spd(moment, sum[a], limit * n0 / D);
    if (!gradient) return std::nullopt;
    sum[a] = *gradient;
  }
  return sum;
}

/// Rate at which the divergence falls while particles go on with their velocities, 1/s^2:
///   -d(div v)/dt = tr(grad v grad v).
template <int D>
double convected_divergence(const std::array<Vec<D>, D>& velocity_gradient) {
  double sum = 0.0;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) sum += velocity_gradient[a][b] * velocity_gradient[b][a];
  return sum;
}

/// Right side of the pressure equation with its sign turned, Pa/m^2, by Tanaka & Masunaga (2010),
/// J. Comput. Phys. 229:
///   -<lap P>_i = -(1 - gamma) rho/dt div v* + gamma rho/dt^2 (n - n0)/n0.
/// The divergence keeps the flow free of compression; the density error, which drives the pressure
/// noise of Eq. (12), only takes back the drift: a share gamma of it in each step.
inline double mixed_source(double divergence, double n, double n0, double rho, double dt,
                           double gamma) {
  return rho / dt * (gamma / dt * (n - n0) / n0 - (1.0 - gamma) * divergence);
}

}  // namespace surge::mps
