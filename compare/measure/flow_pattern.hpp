#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// Volume fraction of water in the square cells of a grid that all runs of a study share (2D). A
/// particle lays its square of side l0 over the cells, a mesh cell its volume fraction, each as
/// much as overlaps; the sum is the same volume of water as in the frame.
class FractionGrid {
 public:
  /// The cells start at the tank's lower corner; `cell` is their edge, m.
  FractionGrid(const Physics& physics, Metres cell);

  void add(const Frame& frame, const Run& run);
  /// Whether a cell is at least half full.
  [[nodiscard]] bool wet(std::size_t cell) const { return fraction_[cell] >= 0.5; }
  [[nodiscard]] std::size_t size() const { return fraction_.size(); }
  /// Water in all cells, m^2; what lies above the grid's top is not in it.
  [[nodiscard]] double area() const;

 private:
  void add_box(double x0, double x1, double y0, double y1, double fraction);

  double left_, floor_, cell_;
  std::size_t up_, columns_, rows_;
  std::vector<double> fraction_;
};

/// Wet cells of both over wet cells of either one: 1 where the regions are the same, 0 where they
/// share nothing. Both must be made from the same physics and cell. 1 where neither has water.
[[nodiscard]] double overlap(const FractionGrid& a, const FractionGrid& b);

/// Water that left the main body (the piece with the most water).
struct Detached {
  std::size_t pieces = 0;  ///< besides the main body
  double part = 0.0;       ///< of all the water, in those pieces
  double blurred = 0.0;    ///< of all the water, in cells too empty to belong to any piece (mesh)
};
/// Particles closer than `linking_length` spacings belong together.
[[nodiscard]] Detached detached(const ParticleFrame& frame, Metres spacing, double linking_length);
/// Corners of at least `level` volume fraction belong together where a face joins them: at 0.5
/// the rule by which the leading edge is measured. Pieces narrower than two cells have no such
/// corner and count as blurred; a lower level finds more of them.
[[nodiscard]] Detached detached(MeshFront& mesh, const MeshFrame& frame, double level);

/// Smallest distance between two particles, m; empty for fewer than two. Sweeps along x: time
/// O(N log N) for particles that fill an area.
[[nodiscard]] std::optional<double> smallest_distance(const std::vector<Vec3>& position);

/// How strictly water must hang together to be one piece: linking lengths in spacings for
/// particles, volume fractions at the corners for a mesh. The middle ones are the study's.
inline constexpr std::size_t cohesion_count = 3;
inline constexpr std::array<double, cohesion_count> linking_lengths{1.5, 2.0, 2.5};
inline constexpr std::array<double, cohesion_count> corner_levels{0.75, 0.5, 0.25};
inline constexpr std::size_t usual_cohesion = 1;

struct PatternSample {
  Seconds time;
  std::optional<double> overlap;  ///< with the reference; where it has a frame at that time too
  std::array<Detached, cohesion_count> detached;
  std::optional<double> smallest_distance;  ///< over l0; particles only
};
using PatternHistory = std::vector<PatternSample>;

/// Edge of the cells in which regions are compared: a whole number of them per column width, none
/// smaller than a particle or a cell of any of the two runs.
[[nodiscard]] Metres overlap_cell(const Run& a, const Run& b);

/// All frames of a run. The overlap is left out in three dimensions and where the reference has no
/// frame within a tenth of a frame interval.
[[nodiscard]] PatternHistory measure_pattern(const Run& run, const Run& reference);

}  // namespace surge::compare
