#pragma once

#include "particle/case/case.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// Obstacles with a surface lie in no other solid: by more than a twentieth of a spacing, or a
/// thousandth of their size. Boxes of fluid may: the obstacle cuts its place out of them. Balls of
/// fluid may not. Throws Error. Part of check_case().
void check_surface_overlaps(const Case& c, const TomlTable& root);

/// Obstacles with a surface are nowhere thinner than `radius` (m), over which particles act on each
/// other, where water can be on both sides, and leave no gap narrower than a spacing to themselves,
/// to other solids and to the tank's walls. Where two faces meet at an angle of 20 degrees or more
/// the body may end in an edge, and water in a wedge. Throws Error. Part of check_case_for().
void check_surface_thickness(const Case& c, const TomlTable& root, double radius);

/// The key that gives an obstacle its place: polygon, stl, vertices or lower.
[[nodiscard]] std::string place_key(const TomlTable& obstacle);

}  // namespace surge
