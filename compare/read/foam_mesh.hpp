#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "compare/read/foam_data.hpp"
#include "compare/read/physics.hpp"

namespace surge::compare {

/// A named part of the boundary: faces start ... start + count - 1.
struct FoamPatch {
  std::string name;
  std::string type;
  std::size_t start = 0;
  std::size_t count = 0;
};

/// The mesh of a case or of one processor of it, as OpenFOAM stores it: faces with the cell on
/// either side.
struct FoamMesh {
  std::vector<Vec3> points;              ///< m
  std::vector<std::size_t> face_start;   ///< first corner of each face in `corners`, and the end
  std::vector<std::uint32_t> corners;    ///< points of the faces
  std::vector<std::uint32_t> owner;      ///< cell per face; its area points out of it
  std::vector<std::uint32_t> neighbour;  ///< cell on the other side, per inner face
  std::vector<FoamPatch> patches;
  std::size_t cells = 0;

  std::vector<Vec3> face_centre;  ///< m
  std::vector<Vec3> face_area;    ///< vector normal to the face, m2
  std::vector<double> volume;     ///< of the cells, m3
  std::vector<Vec3> centre;       ///< of the cells, m
  std::size_t warped_faces = 0;   ///< corners off their plane by more than a tenth of the face
  std::string place;              ///< folder, for messages

  [[nodiscard]] std::size_t faces() const { return owner.size(); }
};

/// A file of the mesh by its name: "points", "faces", "owner", "neighbour", "boundary".
using FoamMeshFile = std::function<FoamBlock(const std::string& name)>;

/// Reads and checks a mesh: indices in range, each cell closed and of positive volume, patches that
/// cover the boundary. Throws surge::Error with the file's name.
[[nodiscard]] FoamMesh read_foam_mesh(const FoamMeshFile& file, const std::string& place);

/// The patch that is the other side of `patch` on another processor is `procBoundary<to>to<from>`.
/// Throws surge::Error unless the faces of all such pairs lie at the same places: the meshes of
/// the processors would not be of one case.
void check_processor_patches(const std::vector<FoamMesh>& meshes);

/// Computes centres, areas and volumes; throws surge::Error where a cell is open or inside out.
void compute_geometry(FoamMesh& mesh);

}  // namespace surge::compare
