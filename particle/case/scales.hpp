#pragma once

#include "particle/case/case.hpp"

namespace surge {

[[nodiscard]] double length(const Point& v);

/// Velocity (m/s) that a block states for a point at time zero, without its wave:
/// velocity + gradient (x - centre).
[[nodiscard]] Point initial_velocity(const FluidBlock& block, const Point& x);

/// Gravity without its components along periodic axes (m/s2): those drive a flow, and nothing at
/// rest balances them.
[[nodiscard]] Point still_gravity(const Case& c);

/// The speed scale of a case, m/s: as the case states it, or sqrt(2 g H), H the height of the
/// highest block along still_gravity() above the tank's floor, or the largest initial speed,
/// whichever is larger.
[[nodiscard]] double reference_speed(const Case& c);

}  // namespace surge
