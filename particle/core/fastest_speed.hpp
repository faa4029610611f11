#pragma once

#include <algorithm>
#include <cmath>

#include "particle/core/parallel_for.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// Largest |v| of all particles, m/s: v_max of Eq. (25)'s Courant number. Walls that move
/// count.
template <int D>
double fastest_speed(const Particles<D>& p) {
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  const auto look = [&](std::ptrdiff_t i, double& fastest) {
    double v2 = 0.0;
    for (int a = 0; a < D; ++a) v2 += p.v[a][i] * p.v[a][i];
    fastest = std::max(fastest, v2);
  };
  return std::sqrt(parallel_reduce(n, worth_sharing, 0.0, look, larger));
}

}  // namespace surge
