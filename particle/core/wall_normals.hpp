#pragma once

#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// Unit normals of wall particles by their ids: of the tank, the obstacle or the moving wall that
/// they stand for; zero for fluid. Their sign is open: only the direction is used. `p` as
/// initial_particles() made them.
template <int D>
std::vector<Vec<D>> wall_normals(const Case& c, const Particles<D>& p);

}  // namespace surge
