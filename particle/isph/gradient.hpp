#pragma once

#include <optional>

#include "particle/core/solve_spd.hpp"
#include "particle/isph/view.hpp"

namespace surge::isph {

/// Least pivot of the matrix of the corrected gradient by which it is trusted; it is 1 inside the
/// fluid and about 1/2 on a flat surface.
inline constexpr double trusted_pivot = 0.4;

/// First-order consistent gradient (Bonet & Lok 1999, Comput. Methods Appl. Mech. Eng. 180):
///   L_i sum_j V (phi_j - phi_i) grad_i W_ij,  L_i = [ sum_j V grad_i W_ij (x_j - x_i)^T ]^-1,
/// exact for linear fields wherever the neighbours are. Where they are too few for L, the sum
/// without it. difference(j) = phi_j - phi_i for the neighbours that `counts` lets in.
template <int D, class K, class Difference, class Counts>
Vec<D> gradient(const View<D>& view, const K& kernel, std::size_t i, Difference&& difference,
                Counts&& counts) {
  std::array<Vec<D>, D> moment{};
  Vec<D> sum{};
  view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>& d, double r) {
    if (!counts(j)) return;
    const double weight = gradient_weight(view.model, kernel, r);
    const double change = difference(j);
    for (int a = 0; a < D; ++a) {
      sum[a] += weight * change * d[a];
      for (int b = 0; b < D; ++b) moment[a][b] += weight * d[a] * d[b];
    }
  });
  const auto exact = solve_spd(moment, sum, trusted_pivot);
  return exact ? *exact : sum;
}

/// The same for a vector, row a being the gradient of its component a; empty where the neighbours
/// are too few.
template <int D, class K, class Difference, class Counts>
std::optional<std::array<Vec<D>, D>> vector_gradient(const View<D>& view, const K& kernel,
                                                     std::size_t i, Difference&& difference,
                                                     Counts&& counts) {
  std::array<Vec<D>, D> moment{};
  std::array<Vec<D>, D> sum{};
  view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>& d, double r) {
    if (!counts(j)) return;
    const double weight = gradient_weight(view.model, kernel, r);
    const Vec<D> change = difference(j);
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) {
        moment[a][b] += weight * d[a] * d[b];
        sum[a][b] += weight * change[a] * d[b];
      }
  });
  for (Vec<D>& row : sum) {
    const auto exact = solve_spd(moment, row, trusted_pivot);
    if (!exact) return std::nullopt;
    row = *exact;
  }
  return sum;
}

/// Gradient of the line fitted by least squares through the velocities of the fluid around a
/// particle, its own left out (moving least squares with a constant: Dilts 1999, Int. J. Numer.
/// Methods Eng. 44), 1/s; row a being that of component a. Exact for linear fields. Empty where the
/// neighbours are too few or on one side: at a surface or a wall.
template <int D, class K>
std::optional<std::array<Vec<D>, D>> velocity_gradient_around(const View<D>& view, const K& kernel,
                                                              std::size_t i) {
  double weights = 0.0;
  Vec<D> place{};
  Vec<D> velocity{};
  std::array<Vec<D>, D> moment{};
  std::array<Vec<D>, D> sum{};
  view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>& d, double r) {
    if (!view.is_fluid(j)) return;
    const double weight = gradient_weight(view.model, kernel, r);
    weights += weight;
    for (int a = 0; a < D; ++a) {
      // Relative to the particle: large means would cost digits.
      const double v = view.p.v[a][j] - view.p.v[a][i];
      place[a] += weight * d[a];
      velocity[a] += weight * v;
      for (int b = 0; b < D; ++b) {
        moment[a][b] += weight * d[a] * d[b];
        sum[a][b] += weight * v * d[b];
      }
    }
  });
  if (weights == 0.0) return std::nullopt;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) {
      moment[a][b] -= place[a] * place[b] / weights;
      sum[a][b] -= velocity[a] * place[b] / weights;
    }
  for (Vec<D>& row : sum) {
    const auto exact = solve_spd(moment, row, trusted_pivot);
    if (!exact) return std::nullopt;
    row = *exact;
  }
  return sum;
}

}  // namespace surge::isph
