#pragma once

#include <algorithm>
#include <functional>
#include <limits>

#include "compare/measure/frame_view.hpp"

namespace surge::compare {

/// Volume that two boxes share along the axes of a frame: m, m2 or m3 with the number of axes.
[[nodiscard]] double shared_volume(const Extent& a, const Extent& b,
                                   const std::vector<std::size_t>& axes);

/// Calls action(box, part) for boxes that together are the space where water can be: the cells of a
/// mesh, each with the part of its box that it fills; for particles the tank with 1 and its
/// obstacles with -1. A tank without a lid ends at `top`; where a level side is not known, the
/// water's own extent stands for it.
void for_each_open(FrameView& view, double top,
                   const std::function<void(const Extent& box, double part)>& action);

/// Whether a place, without entry for axes that do not matter (not finite), is inside of the mesh
/// or of what is known of the tank.
[[nodiscard]] bool is_inside(FrameView& view, const Vec3& place);

/// One spacing, or of a mesh the median extents of the cells that the place lies in; an entry of
/// the place that is not finite stands for any.
[[nodiscard]] Vec3 resolution_at(FrameView& view, const Vec3& place);

}  // namespace surge::compare
