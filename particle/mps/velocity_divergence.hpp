#pragma once

#include <optional>
#include <type_traits>

#include "particle/mps/gradient.hpp"
#include "particle/mps/number_density.hpp"

namespace surge::mps {

/// f of whole vectors of particles: f(LaneIndices), or f(j) of each of them.
template <int D, class F>
SURGE_INLINE inline std::array<Simd, D> vectors_of(const LaneIndices& j, F&& f) {
  if constexpr (std::is_invocable_v<F, const LaneIndices&>) {
    return f(j);
  } else {
    std::array<Vec<D>, simd_width> each;
    for (std::size_t k = 0; k < simd_width; ++k) each[k] = f(std::size_t{j[k]});
    std::array<Simd, D> all;
    for (int a = 0; a < D; ++a) all[a] = Simd([&](auto lane) { return each[lane][a]; });
    return all;
  }
}

/// Velocity divergence by the gradient model of Eq. (5), 1/s:
///   <div v>_i = d/n0 sum_{j != i} (v_j - v_i) . (x_j - x_i) / |x_j - x_i|^2 w(|x_j - x_i|).
/// re in m; relative(j) = v_j - v_i in m/s, of one particle or of LaneIndices. The flux that all
/// particles on one side of a plane see through it is the one that the Laplacian model balances.
/// Exact for linear fields on a lattice only: where the lattice is stretched, the shear of the flow
/// passes for divergence.
template <int D, class Relative, class Counts>
double velocity_divergence(std::size_t i, std::span<const std::uint32_t> neighbours,
                           const Displacement<D>& displacement, double re, double n0,
                           Relative&& relative, Counts&& counts) {
  Simd sum = 0.0;
  for_each_lanes_within<D>(
      i, neighbours, displacement, re, counts,
      [&](const LaneIndices& j, const std::array<Simd, D>& d, Simd, Simd weight) SURGE_INLINE {
        const std::array<Simd, D> v = vectors_of<D>(j, relative);
        Simd approach = 0.0;
        for (int a = 0; a < D; ++a) approach += v[a] * d[a];
        sum += approach * weight;
      });
  return D / n0 * stdx::reduce(sum);
}

/// The velocity gradient by the corrected gradient model (Khayyer & Gotoh 2011), 1/s, row a being
/// the gradient of v_a:
///   [ sum (v_j - v_i) (x_j - x_i)^T / r^2 w ] C_i,
/// exact for linear fields wherever the neighbours are. Empty where they are too few for C, see
/// corrected_gradient(). relative(j) = v_j - v_i in m/s, of one particle or of LaneIndices.
template <int D, class Relative, class Counts>
std::optional<std::array<Vec<D>, D>> velocity_gradient(std::size_t i,
                                                       std::span<const std::uint32_t> neighbours,
                                                       const Displacement<D>& displacement,
                                                       double re, double n0, double limit,
                                                       Relative&& relative, Counts&& counts) {
  std::array<Simd, D*(D + 1) / 2> moments{};
  std::array<std::array<Simd, D>, D> sums{};  // one row per component of v
  for_each_lanes_within<D>(
      i, neighbours, displacement, re, counts,
      [&](const LaneIndices& j, const std::array<Simd, D>& d, Simd, Simd weight) SURGE_INLINE {
        const std::array<Simd, D> v = vectors_of<D>(j, relative);
        for (int a = 0; a < D; ++a)
          for (int b = 0; b < D; ++b) sums[a][b] += weight * v[a] * d[b];
        add_moments<D>(weight, d, moments);
      });
  const auto moment = symmetric<D>(moments);
  std::array<Vec<D>, D> sum;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) sum[a][b] = stdx::reduce(sums[a][b]);
  return solve_spd(moment, sum, limit * n0 / D);
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
