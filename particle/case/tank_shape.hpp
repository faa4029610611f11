#pragma once

#include <vector>

#include "particle/case/closed_surface.hpp"

namespace surge {

/// What fills a tank's box around a room of another shape: together they are the box without the
/// room, and no two of them have more than a face in common.
///
/// In 2D the room may touch the box, as it does where a side is open; between two places where it
/// does lies one body. A room that touches nowhere, or at one corner, has one body above and one
/// below it, cut along its lines from the lowest and the highest x to the box. In 3D there is one
/// body with the room as a hollow, and the room may not touch the box.
///
/// Throws Error ("found ..., expected ...") where the room is not in the box, or touches it in 3D.
[[nodiscard]] std::vector<ClosedSurface> bodies_around(const ClosedSurface& room, const Box& box);

}  // namespace surge
