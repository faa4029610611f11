#pragma once

#include <optional>

#include "compare/measure/frame_view.hpp"

namespace surge::compare {

/// A place seen from above. Without `across`, in 3D, the whole width.
struct Place {
  double x = 0.0;                ///< m, along the surge
  std::optional<double> across;  ///< m, along the other level axis; means nothing in 2D
};

/// Height of the water at a place, m above the tank's floor: of the highest z at which the volume
/// fraction, averaged over a box around the place, is one half,
///   phi(z) = int_B f dV / int_B dV = 1/2,   B = [x - s_x, x + s_x] x [z - s_z, z + s_z]  (x
///   across),
/// over what of the box is neither wall nor obstacle. f is the water of the frame: particles are
/// full squares (cubes) of side l0, cells hold their volume fraction. s is one spacing l0, or one
/// cell: the median extent, per axis, of the cells on the vertical through the place. For plane
/// surfaces, level or not, that is the surface itself, on a lattice and on a mesh, wherever it cuts
/// the cells; without `across` it is, to a spacing, the height to which half of the width is wet.
///
/// Drops in the air do not count (FrameView::settled), nor does water that is thinner than a
/// spacing in the air. Where water hangs over, its highest surface counts. A film on the floor
/// thinner than a cell is read too low by up to half a cell. 0 where the place is dry. Throws
/// surge::Error for a place outside of the tank or mesh.
[[nodiscard]] double water_height(FrameView& view, const Place& place);

}  // namespace surge::compare
