#pragma once

#include <string>
#include <vector>

#include "foam_cases/case_files.hpp"

namespace surge::foam {

/// Whether a moving wall is a piston: it fills the tank across its direction, from floor to above
/// the water, so that its face is a side of the mesh.
[[nodiscard]] bool is_piston(const Case& c, const MovingWall& wall);

/// The pistons of a case. Its tank then begins at their faces, and its moving walls are the others.
/// Throws Error for a piston with water on both sides, one that is not at displacement zero at the
/// start, or one that meets something on its way.
[[nodiscard]] std::vector<Piston> take_pistons(Case& c);

// Files that a case with pistons has besides; empty without them.
[[nodiscard]] std::string dynamic_mesh(const FoamCase& c);
[[nodiscard]] std::string point_displacement(const FoamCase& c);
/// Table of time and displacement of a piston.
[[nodiscard]] std::string piston_table(const FoamCase& c, const Piston& piston);
[[nodiscard]] std::string piston_file(const Piston& piston);

}  // namespace surge::foam
