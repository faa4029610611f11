#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "compare/measure/mesh_topology.hpp"
#include "compare/read/pieces.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// Volume fraction at a corner of a mesh from which on it counts as wet.
inline constexpr double interface_level = 0.5;
/// Particles closer than this many spacings belong together: the gap between two particles of
/// diameter l0 is then smaller than a particle, the smallest gap that the spacing resolves. On a
/// mesh the same rule holds by itself: one dry cell between two full ones gives corners of 0.5.
inline constexpr double usual_linking_length = 2.0;

/// One frame as parcels of water, the same for particles and meshes: a particle is a full square
/// (cube) of side l0 around its centre, a cell holds its volume fraction. What several observables
/// need of a frame is found once, when it is asked for first; what only depends on the mesh is kept
/// from frame to frame.
class FrameView {
 public:
  FrameView(const Physics& physics, Metres spacing);

  /// Looks at another frame. Its mesh may be another one too.
  void show(Frame frame);

  [[nodiscard]] const Physics& physics() const { return physics_; }
  [[nodiscard]] double spacing() const { return spacing_; }  ///< l0, or the cell along x, m
  [[nodiscard]] Seconds time() const { return time_of(frame_); }
  [[nodiscard]] const ParticleFrame* particles() const {
    return std::get_if<ParticleFrame>(&frame_);
  }
  [[nodiscard]] const MeshFrame* mesh() const { return std::get_if<MeshFrame>(&frame_); }

  [[nodiscard]] std::size_t up() const { return up_; }          ///< axis against gravity
  [[nodiscard]] std::size_t across() const { return 3 - up_; }  ///< level, normal to the surge
  /// x, up and, in 3D, across, in the order of the coordinates.
  [[nodiscard]] const std::vector<std::size_t>& axes() const { return axes_; }

  /// Number of parcels; cells without water are parcels too.
  [[nodiscard]] std::size_t size() const;
  /// Water in a parcel: m3; in 2D m2, that is m3 per metre of width.
  [[nodiscard]] double volume(std::size_t i) const;
  /// Part of the parcel's box that is water.
  [[nodiscard]] double fraction(std::size_t i) const;
  /// Part of a cell's box that is the cell: 1 for cells along the axes.
  [[nodiscard]] double cell_part(std::size_t i) const;
  [[nodiscard]] const Vec3& centre(std::size_t i) const;
  /// Along axes() only.
  [[nodiscard]] Extent box(std::size_t i) const;
  [[nodiscard]] bool has_velocity() const;
  [[nodiscard]] bool has_pressure() const;
  [[nodiscard]] Vec3 velocity(std::size_t i) const;    ///< m/s
  [[nodiscard]] double pressure(std::size_t i) const;  ///< Pa
  /// All water, m3 or m2.
  [[nodiscard]] double all_water() const;

  /// Per parcel: 1 where it belongs to the main body, the connected piece with the most water, or
  /// to a piece that stands on the floor or on an obstacle, lower than a spacing above it; 0 for
  /// drops in the air. A cell belongs to a piece that has one of its corners.
  [[nodiscard]] const std::vector<std::uint8_t>& settled();

  /// Obstacles with a surface as boxes about a spacing wide, each with the part that is solid.
  [[nodiscard]] const std::vector<std::pair<Extent, double>>& surface_boxes();

  /// Of particles.
  [[nodiscard]] const Pieces& pieces(double linking_length);
  /// Of a mesh.
  [[nodiscard]] MeshTopology& topology();
  [[nodiscard]] const CornerWater& corners();
  [[nodiscard]] const MeshBodies& bodies(double level);
  /// Of the mesh in 2D: its one cell, m; 1 otherwise.
  [[nodiscard]] double thickness() const { return thickness_; }

 private:
  [[nodiscard]] bool stands(const Vec3& x, double reach) const;
  std::vector<std::pair<Extent, double>> surface_boxes_;
  bool has_surface_boxes_ = false;

  Physics physics_;
  double spacing_;
  std::size_t up_;
  std::vector<std::size_t> axes_;
  Frame frame_;
  std::unique_ptr<MeshTopology> topology_;
  double thickness_ = 1.0;
  std::optional<CornerWater> corners_;
  std::map<double, MeshBodies> bodies_;
  std::map<double, Pieces> pieces_;
  std::vector<std::uint8_t> settled_;
};

}  // namespace surge::compare
