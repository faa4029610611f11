#pragma once

#include <string>
#include <vector>

#include "compare/figures/image.hpp"
#include "compare/figures/style.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// What is drawn of a particle or a cell; lengths over L, from the column's wall, the floor and, in
/// 3D, the tank's lower side along the depth.
struct WaterPatch {
  double x = 0.0, y = 0.0;            ///< centre
  double half_x = 0.0, half_y = 0.0;  ///< radius of a particle, half the edges of a cell
  double pressure = 0.0;              ///< p/(rho g H), H the column's height; NaN: not known
  double fraction = 1.0;              ///< volume fraction of water
  double speed = 0.0;                 ///< |u|/sqrt(2gH); NaN where the frame has no velocity
  double z = 0.0, half_z = 0.0;       ///< along the depth; zero in 2D and in a slice
};

struct Segment {
  double x0, y0, x1, y1;
};

/// One frame in the vertical plane of the picture (in 3D the plane halfway through the tank).
struct WaterPicture {
  bool mesh = false;
  std::vector<WaterPatch> patches;
  std::vector<Segment> surface;  ///< alpha = 0.5 on a mesh; empty for particles

  /// Height over L below which the given part of the water lies.
  [[nodiscard]] double height_of(double part) const;
  /// Part of the water above a height over L.
  [[nodiscard]] double part_above(double height) const;
  void paint(Image& image) const;
};

/// Colour of water whose pressure or speed is not known.
inline constexpr Colour unknown_colour{0x9a, 0x9a, 0x9a};

/// Cells are taken as their bounding boxes, which is exact for the hexahedra of a box mesh. Throws
/// Error where a mesh has no pressure; particles of other programs may have none.
[[nodiscard]] WaterPicture water_picture(const Frame& frame, const Run& run);

/// The same of all the water of a run in 3D, not of its slice alone: the patches, without a
/// surface.
[[nodiscard]] std::vector<WaterPatch> water_in_space(const Frame& frame, const Run& run);

}  // namespace surge::compare
