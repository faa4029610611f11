#pragma once

#include "particle/case/case.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// Checks what single entries cannot show: that the bodies fit into the tank and not into each
/// other, that the spacing divides them, that periods hold two interaction radii and so on.
/// `root` is the file that the case was read from, for the places of errors. Throws Error.
void check_case(const Case& c, const TomlTable& root);

/// The largest distance (m) over which two particles of the case's method act on each other.
[[nodiscard]] double interaction_radius(const Case& c);

/// Number of fluid particles that fill the blocks at the case's spacing; of balls by their volume.
[[nodiscard]] double fluid_particle_count(const Case& c);

/// A guess of the number of steps to the end: Eq. (25) with the case's reference speed, and the
/// method's acoustic limit. The flow is slower most of the time, so that there are fewer.
[[nodiscard]] double estimated_steps(const Case& c);

}  // namespace surge
