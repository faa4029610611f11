#pragma once

#include <algorithm>

#include "particle/mps/number_density.hpp"

namespace surge::mps {

// Eq. (6)
/// The least value of phi among i and those of its neighbours within re (m) that `counts` lets in
/// (Koshizuka, Nobe & Oka 1998). w(0) does not vanish, so i itself is one of them.
template <int D, class Phi, class Counts>
double neighbourhood_minimum(std::size_t i, std::span<const std::uint32_t> neighbours,
                             const Displacement<D>& displacement, double re, Phi&& phi, Counts&& counts) {
  double least = phi(i);
  for (const std::uint32_t j : neighbours)
    if (counts(j) && squared_norm<D>(displacement(i, j)) < re * re) least = std::min(least, phi(j));
  return least;
}

// Eq. (5)
/// Gradient model (Koshizuka & Oka 1996) with a reference value phi'_i in place of phi_i:
///   <grad phi>_i = d/n0 sum_{j != i} (phi_j - phi'_i) / |x_j - x_i|^2 (x_j - x_i) w(|x_j - x_i|).
/// re in m; the result has the unit of phi per m.
template <int D, class Phi, class Counts>
Vec<D> gradient(std::size_t i, std::span<const std::uint32_t> neighbours, const Displacement<D>& displacement,
                double re, double n0, double reference, Phi&& phi, Counts&& counts) {
  Vec<D> sum{};
  for (const std::uint32_t j : neighbours) {
    if (!counts(j)) continue;
    const Vec<D> d = displacement(i, j);
    const double r2 = squared_norm<D>(d);
    if (r2 >= re * re || r2 == 0.0) continue;
    const double factor = (phi(j) - reference) / r2 * mps_weight(std::sqrt(r2), re);
    for (int a = 0; a < D; ++a) sum[a] += factor * d[a];
  }
  for (double& component : sum) component *= D / n0;
  return sum;
}

}  // namespace surge::mps
