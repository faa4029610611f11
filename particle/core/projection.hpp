#pragma once

#include "particle/core/particles.hpp"

namespace surge {

/// A vector without its part along a normal of any length; all of it where the normal is zero.
template <std::size_t D>
std::array<double, D> without_part_along(std::array<double, D> v,
                                         const std::array<double, D>& normal) {
  double dot = 0.0;
  double square = 0.0;
  for (std::size_t a = 0; a < D; ++a) {
    dot += v[a] * normal[a];
    square += normal[a] * normal[a];
  }
  if (square > 0.0)
    for (std::size_t a = 0; a < D; ++a) v[a] -= dot / square * normal[a];
  return v;
}

}  // namespace surge
