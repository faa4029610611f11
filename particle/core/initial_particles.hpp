#pragma once

#include <vector>

#include "particle/case/case.hpp"
#include "particle/case/scales.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// The particles at time zero: fluid on a lattice of spacing l0 inside the blocks, and
/// `wall_layers` layers of fixed particles outside the tank's walls and inside the obstacles. The
/// layer next to the fluid has type wall, the others dummy. An obstacle with a surface cuts its
/// place out of the blocks; its layers are the places of the tank's lattice inside it that are no
/// deeper below its surface. Fluid comes first, moving walls come last, at displacement zero; ids
/// count from 0 in that order. Pressure and density are zero.
template <int D>
Particles<D> initial_particles(const Case& c, int wall_layers);

/// First id of each moving wall among so many `particles`, and one past the last id of the last.
template <int D>
std::vector<std::int32_t> moving_wall_ids(const Case& c, int wall_layers, std::size_t particles);

/// Depth below the top of the fluid block that a point lies in or next to (within `reach`), along
/// still_gravity(), m; 0 where there is no such block or no gravity. For hydrostatic initial
/// states.
template <int D>
double initial_depth(const Case& c, const Vec<D>& x, double reach);

}  // namespace surge
