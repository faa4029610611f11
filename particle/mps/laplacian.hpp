#pragma once

#include "particle/mps/number_density.hpp"
#include "particle/mps/params.hpp"

namespace surge::mps {

// Eq. (8)
/// lambda = int w r^2 dV / int w dV in m^2, for an effective radius re = re_over_l0 l0. With
/// w = re/r - 1 the integrals are
///   int_0^re (re/r - 1) r^(D+1) dr / int_0^re (re/r - 1) r^(D-1) dr
///     = [re^(D+2) / ((D+1)(D+2))] / [re^D / ((D-1) D)] = re^2 D (D-1) / ((D+1)(D+2)),
/// re^2/6 in 2D and 3 re^2/10 in 3D. The paper prints re^2/12.
template <int D>
double laplacian_lambda(Lambda choice, double re_over_l0, double l0) {
  const double re = re_over_l0 * l0;
  switch (choice) {
    case Lambda::paper:
      return re * re / 12.0;
    case Lambda::analytic:
      return re * re * D * (D - 1) / ((D + 1.0) * (D + 2.0));
    case Lambda::lattice:
      break;
  }
  const double moment =
      lattice_sum<D>(re_over_l0, [&](double r) { return mps_weight(r, re_over_l0) * r * r; });
  return moment / reference_number_density<D>(re_over_l0) * l0 * l0;
}

// Eq. (7)
/// Laplacian model (Koshizuka & Oka 1996):
///   <lap phi>_i = 2 d / (n0 lambda) sum_{j != i} (phi_j - phi_i) w(|x_j - x_i|).
/// Sum and factor apart, since the pressure equation needs the weights as matrix entries.
/// n0 belongs to the same re as w; the factor is in 1/m^2.
template <int D>
double laplacian_factor(double n0, double lambda) {
  return 2.0 * D / (n0 * lambda);
}

/// sum_{j != i} (phi_j - phi_i) w for the neighbours that `counts` lets in; re in m.
template <int D, class Phi, class Counts>
double laplacian_sum(std::size_t i, std::span<const std::uint32_t> neighbours,
                     const Displacement<D>& displacement, double re, Phi&& phi, Counts&& counts) {
  double sum = 0.0;
  const double phi_i = phi(i);
  for (const std::uint32_t j : neighbours) {
    if (!counts(j)) continue;
    sum += (phi(j) - phi_i) * mps_weight(std::sqrt(squared_norm<D>(displacement(i, j))), re);
  }
  return sum;
}

/// (D + 2) sum_{j != i} [(v_j - v_i) . e] e w with e = (x_j - x_i)/r, for the neighbours that
/// `counts` lets in; times the same factor it is lap v + 2 grad div v: the mean of e e e e over
/// directions is (1 + 1 + 1)/(D (D + 2)) where that of e e is 1/D. The pairwise form of Monaghan &
/// Gingold (1983), J. Comput. Phys. 52, with the weights of MPS. Where the sum is one-sided, it
/// gives div 2D and with it the stress-free surface in the sense of the energy balance, which the
/// Laplacian does not (Colagrossi et al. 2011, Phys. Rev. E 84, 026705), and it conserves angular
/// momentum.
template <int D, class Counts>
Vec<D> deformation_sum(std::size_t i, std::span<const std::uint32_t> neighbours,
                       const Displacement<D>& displacement, double re,
                       const std::array<Field, D>& v, Counts&& counts) {
  std::array<Simd, D> sums{};
  for_each_lanes_within<D>(
      i, neighbours, displacement, re, counts,
      [&](const LaneIndices& j, const std::array<Simd, D>& d, Simd, Simd weight) SURGE_INLINE {
        Simd approach = 0.0;
        for (int a = 0; a < D; ++a) approach += (pick(v[a], j) - v[a][i]) * d[a];
        for (int a = 0; a < D; ++a) sums[a] += weight * approach * d[a];
      });
  Vec<D> sum;
  for (int a = 0; a < D; ++a) sum[a] = (D + 2) * stdx::reduce(sums[a]);
  return sum;
}

}  // namespace surge::mps
