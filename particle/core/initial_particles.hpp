#pragma once

#include "particle/case/case.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// The particles at time zero: fluid on a lattice of spacing l0 inside the blocks, and
/// `wall_layers` layers of fixed particles outside the tank's walls and inside the obstacles. The
/// layer next to the fluid has type wall, the others dummy. Fluid comes first; ids count from 0 in
/// that order. Pressure and density are zero.
template <int D>
Particles<D> initial_particles(const Case& c, int wall_layers);

/// Gravity without its components along periodic axes (m/s2): those drive a flow, and nothing at
/// rest balances them.
Point still_gravity(const Case& c);

/// Depth below the top of the fluid block that a point lies in or next to (within `reach`), along
/// still_gravity(), m; 0 where there is no such block or no gravity. For hydrostatic initial
/// states.
template <int D>
double initial_depth(const Case& c, const Vec<D>& x, double reach);

/// The speed scale of a case, m/s: as the case states it, or sqrt(2 g H), H the height of the
/// highest block along still_gravity() above the tank's floor, or the largest initial speed,
/// whichever is larger.
double reference_speed(const Case& c);

}  // namespace surge
