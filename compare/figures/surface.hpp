#pragma once

#include <vector>

#include "compare/figures/solids.hpp"
#include "compare/figures/water.hpp"

namespace surge::compare {

/// The free surface of a picture. Of a mesh it is the picture's own line, alpha = 0.5. Of particles
/// it is where their covered part
///   c(x) = sum_i W((x - x_i)/l0) W((y - y_i)/l0),
/// W the quadratic B-spline, is a half: c is 1 inside a lattice and 1/2 half a spacing beyond its
/// outermost particles. Particles near a wall of the tank count once more behind it, so that the
/// line meets the wall; along obstacles and walls that move, where there is no surface, it is left
/// out. c is found on corners l0 apart, the line between them by marching squares.
[[nodiscard]] std::vector<Segment> free_surface(const WaterPicture& picture, const Solids& solids,
                                                Seconds time);

/// Segments of the level in one box of four corner values, anticlockwise from the lower left.
void add_level(const Rectangle& box, const std::array<double, 4>& above,
               std::vector<Segment>& lines);

}  // namespace surge::compare
