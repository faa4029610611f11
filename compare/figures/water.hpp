#pragma once

#include <string>
#include <vector>

#include "compare/figures/image.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// What is drawn of a particle or a cell; lengths over L, from the column's wall and the floor.
struct WaterPatch {
  double x = 0.0, y = 0.0;            ///< centre
  double half_x = 0.0, half_y = 0.0;  ///< radius of a particle, half the edges of a cell
  double pressure = 0.0;              ///< p/(rho g H), H the column's height
  double fraction = 1.0;              ///< volume fraction of water
  double speed = 0.0;                 ///< |u|/sqrt(2gH); 0 where the frame has no velocity
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

/// Cells are taken as their bounding boxes, which is exact for the hexahedra of a box mesh. Throws
/// Error where the frame has no pressure.
[[nodiscard]] WaterPicture water_picture(const Frame& frame, const Run& run);

}  // namespace surge::compare
