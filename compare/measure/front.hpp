#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "compare/read/run.hpp"
#include "compare/read/units.hpp"

namespace surge::compare {

/// How the leading edge is measured: the same on both sides.
struct FrontOptions {
  /// Only water up to this height above the floor counts; the number belongs to the study.
  Metres strip_height{0.015};
  /// Particles closer than this many spacings belong together. 2: the gap between two particles
  /// of diameter l0 is smaller than a particle, the smallest gap that the spacing resolves. On
  /// the mesh the same rule holds by itself: one dry cell between two full ones gives corners of
  /// alpha = 0.5.
  double linking_length = 2.0;
  /// Farthest water of all, drops that left the main body and water above the strip included.
  bool raw_maximum = false;
};

struct FrontSample {
  Seconds time;
  Metres position;  ///< of the leading edge, from the wall that the column stands at
};
using FrontHistory = std::vector<FrontSample>;

/// A front in the units of the comparison: T increasing, all values finite.
struct DimensionlessFront {
  struct Sample {
    DimensionlessTime time;
    DimensionlessLength position;
  };
  std::vector<Sample> samples;

  /// Linear between samples; empty outside them (nothing is extrapolated).
  [[nodiscard]] std::optional<DimensionlessLength> at(DimensionlessTime time) const;
  /// First time at which the front is at `level`, linear between samples; empty where it never is
  /// or already was at the first sample.
  [[nodiscard]] std::optional<DimensionlessTime> arrival(DimensionlessLength level) const;
};

/// x of the leading edge of one frame (m, the frame's own coordinate): the farthest x, seen from
/// the wall that the column stands at (Physics::surge_direction()), reached by water that is
/// connected to the main body within the strip above the floor. Particles: centre
/// + l0/2, connected by the linking length. Mesh: the alpha = 0.5 contour of the corner values
/// (means of the cells around), connected through the mesh. The main body is the connected
/// region with the most water. Empty where it has no water in the strip.
[[nodiscard]] std::optional<double> leading_edge(const ParticleFrame& frame, const Physics& physics,
                                                 Metres spacing, const FrontOptions& options);

/// The mesh's part of leading_edge: corners, faces and weights are found once for all frames.
class MeshFront {
 public:
  MeshFront();
  ~MeshFront();
  MeshFront(MeshFront&&) noexcept;
  MeshFront& operator=(MeshFront&&) noexcept;
  [[nodiscard]] std::optional<double> leading_edge(const MeshFrame& frame, const Physics& physics,
                                                   const FrontOptions& options);

  /// Connected bodies of water: corners of at least `level` volume fraction that share the edge of
  /// a face belong together; the corner values are those of leading_edge.
  struct Bodies {
    std::vector<double> volumes;  ///< m^3 of water at the corners of each body, decreasing
    double all = 0.0;             ///< m^3 of water in all cells
  };
  [[nodiscard]] Bodies pieces(const MeshFrame& frame, double level);

 private:
  struct Topology;
  std::unique_ptr<Topology> topology_;
};

/// Reads the frames of a run, one at a time, until one has no leading edge any more (a broken run):
/// the history is then shorter than run.frames->times(). Throws surge::Error where the first frame
/// has none.
[[nodiscard]] FrontHistory measure_front(Run& run, const FrontOptions& options);

[[nodiscard]] DimensionlessFront dimensionless(const FrontHistory& history, const Scales& scales);

/// Columns time_s,T,Z_over_L.
void write_front_csv(const std::filesystem::path& file, const FrontHistory& history,
                     const Scales& scales);

}  // namespace surge::compare
