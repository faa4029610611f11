#pragma once

#include <optional>

#include "particle/case/case.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// The surface that a table states: polygon (2D), or stl, or vertices with triangles (3D); nothing
/// where it states none. Throws Error with the place of what is wrong.
[[nodiscard]] std::optional<ClosedSurface> read_surface(const TomlTable& table, int dimension);

/// An [[obstacle]]: a box (lower, upper), a polygon (2D), or a surface of triangles (3D) from an
/// STL file or from lists of vertices and triangles. Throws Error with the place of what is wrong.
[[nodiscard]] Obstacle read_obstacle(const TomlTable& table, int dimension);

/// The bodies that fill the box of a tank around the room that its table states, none where it is a
/// box. Where the table has no lower and upper, `tank` gets the room's own (2D).
[[nodiscard]] std::vector<Obstacle> read_room(const TomlTable& table, int dimension, Tank& tank);

}  // namespace surge
