#pragma once

#include "particle/case/case.hpp"

namespace surge {

/// How many particles initial_particles() makes, in double precision because it may be more than
/// any memory or whole number holds.
struct ParticleCount {
  double fluid = 0.0;
  double wall = 0.0;  ///< wall and dummy particles
  [[nodiscard]] double all() const { return fluid + wall; }
};

/// Counts without making any, in a time that does not grow with the number. Exact up to balls of a
/// million rows of particles, and surfaces around a million of them, which count by their volume.
[[nodiscard]] ParticleCount count_particles(const Case& c, int wall_layers);

}  // namespace surge
