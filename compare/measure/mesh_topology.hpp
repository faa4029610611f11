#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

using MeshIndex = std::uint32_t;
using MeshEdge = std::array<MeshIndex, 2>;

/// Lists of different lengths, one behind the other.
struct MeshLists {
  std::vector<std::size_t> start{0};
  std::vector<MeshIndex> entries;

  void close() { start.push_back(entries.size()); }
  [[nodiscard]] std::size_t size() const { return start.size() - 1; }
  [[nodiscard]] const MeshIndex* begin(std::size_t i) const { return entries.data() + start[i]; }
  [[nodiscard]] std::size_t length(std::size_t i) const { return start[i + 1] - start[i]; }
};

/// What a mesh is without the values in it: found once for all frames that share it. Corners that
/// processors share are one.
class MeshTopology {
 public:
  explicit MeshTopology(vtkUnstructuredGrid& grid);
  /// Whether it is that of `grid`.
  [[nodiscard]] bool describes(vtkUnstructuredGrid& grid) const;

  [[nodiscard]] std::size_t size() const { return cells.size(); }
  /// The faces that reach into a strip along axis `up`. Found once for a strip.
  [[nodiscard]] const std::vector<std::size_t>& faces_between(double lower, double upper,
                                                              std::size_t up);

  std::vector<Vec3> points;     ///< m
  MeshLists cells;              ///< corners per cell
  MeshLists faces;              ///< corners per face, each face once
  std::vector<MeshEdge> edges;  ///< of the faces, each once
  /// Per cell: sum of the pyramids from its middle over its faces; exact where faces are flat and
  /// cells convex. m3
  std::vector<double> volume;
  std::vector<Vec3> centre;  ///< per cell: centre of that volume, m
  std::vector<Extent> box;   ///< per cell: lower and upper corner, m
  Extent bounds;             ///< of all points

 private:
  std::vector<Vec3> raw_points_;  ///< as the grid has them
  std::vector<std::size_t> strip_faces_;
  double strip_lower_ = std::numeric_limits<double>::quiet_NaN();
  double strip_upper_ = strip_lower_;
  std::size_t strip_up_ = 0;
};

/// Volume fraction at the corners of a mesh: the mean over the cells around each.
struct CornerWater {
  CornerWater(const MeshTopology& mesh, const std::vector<double>& alpha);

  std::vector<double> alpha;
  std::vector<double> volume;  ///< of the water that each corner stands for, m3
};

/// Connected bodies of water: corners of at least `level` that share the edge of a face belong
/// together. Bodies are numbered from the one with the most water on.
struct MeshBodies {
  MeshBodies(const MeshTopology& mesh, const CornerWater& water, double level);

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> body_of;  ///< per corner; none where it is dry
  std::vector<double> volumes;       ///< per body, m3, decreasing
};

}  // namespace surge::compare
