#pragma once

#include <algorithm>
#include <cmath>

#include "particle/core/particles.hpp"

namespace surge {

/// Largest |v| of all particles, m/s: v_max of Eq. (25)'s Courant number. Walls that move
/// count.
template <int D>
double fastest_speed(const Particles<D>& p) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  double fastest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : fastest)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double v2 = 0.0;
    for (int a = 0; a < D; ++a) v2 += p.v[a][i] * p.v[a][i];
    fastest = std::max(fastest, v2);
  }
  return std::sqrt(fastest);
}

}  // namespace surge
