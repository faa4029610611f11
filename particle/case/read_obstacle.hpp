#pragma once

#include "particle/case/case.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// An [[obstacle]]: a box (lower, upper), a polygon (2D), or a surface of triangles (3D) from an
/// STL file or from lists of vertices and triangles. Throws Error with the place of what is wrong.
[[nodiscard]] Obstacle read_obstacle(const TomlTable& table, int dimension);

}  // namespace surge
