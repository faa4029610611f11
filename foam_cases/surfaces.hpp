#pragma once

#include <string>

#include "foam_cases/case_files.hpp"

namespace surge::foam {

// Obstacles with a surface (polygons, triangles): cells whose middles they hold are cut out of the
// mesh, by topoSet and subsetMesh after blockMesh. What is left of them has the faces of cells.

[[nodiscard]] bool has_surfaces(const Case& c);

/// constant/triSurface/obstacleN.stl, system/cutDict.obstacleN, and for manifest.json
/// constant/obstacles.json: all obstacles as a manifest states them, and the volume (m3, in 2D m2)
/// that their surfaces take from the boxes of water. Empty where no obstacle has a surface.
[[nodiscard]] Files surface_files(const FoamCase& c);

/// Whether the cell around a place is cut out.
[[nodiscard]] bool is_cut(const FoamCase& c, const Point& x);

/// The place itself, or where its cell is cut out the middle of the first cell that is not, on the
/// way out of the surface. Throws Error where that is more than five cells off.
[[nodiscard]] Point in_remaining_cell(const FoamCase& c, const Point& x, const std::string& what);

}  // namespace surge::foam
