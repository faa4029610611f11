#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "compare/measure/frame_view.hpp"
#include "compare/measure/observable.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// Volume fraction of water in the square (cubic) cells of a grid that all runs of a study share. A
/// particle lays its square (cube) of side l0 over the cells, a mesh cell its volume fraction, each
/// as much as overlaps; the sum is the same volume of water as in the frame.
class FractionGrid {
 public:
  /// The cells start at the tank's lower corner; `cell` is their edge, m.
  FractionGrid(const Physics& physics, Metres cell);

  void add(const FrameView& frame);
  /// Whether a cell is at least half full.
  [[nodiscard]] bool wet(std::size_t cell) const { return fraction_[cell] >= 0.5; }
  [[nodiscard]] std::size_t size() const { return fraction_.size(); }
  [[nodiscard]] std::vector<bool> wet() const;
  /// Of a cell, along FrameView::axes() only, m.
  [[nodiscard]] Extent box_of(std::size_t cell) const;
  /// Water in all cells, m2 or m3; what lies above the grid's top is not in it.
  [[nodiscard]] double volume() const;

 private:
  void add_box(const Extent& box, double fraction);

  std::vector<std::size_t> axes_;
  double cell_;
  Vec3 origin_{};
  std::array<std::size_t, 3> count_{1, 1, 1};
  std::vector<double> fraction_;
};

/// Wet cells of both over wet cells of either one: 1 where the regions are the same, 0 where they
/// share nothing. Both must be made from the same physics and cell. 1 where neither has water.
[[nodiscard]] double overlap(const FractionGrid& a, const FractionGrid& b);
[[nodiscard]] double overlap(const FractionGrid& a, const std::vector<bool>& b);

/// Water that left the main body (the piece with the most water).
struct Detached {
  std::size_t pieces = 0;  ///< besides the main body
  double part = 0.0;       ///< of all the water, in those pieces
  double blurred = 0.0;    ///< of all the water, in cells too empty to belong to any piece (mesh)
};
/// How strictly water must hang together to be one piece. Particles closer than `linking_length`
/// spacings belong together; corners of a mesh of at least `corner_level` volume fraction do where
/// a face joins them. The usual values are those by which the leading edge is measured. In a mesh
/// pieces narrower than two cells have no such corner and count as blurred; a lower level finds
/// more of them.
struct Cohesion {
  double linking_length = usual_linking_length;
  double corner_level = interface_level;
};
[[nodiscard]] Detached detached(FrameView& frame, const Cohesion& cohesion = {});

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

/// The reference's frame at a time; empty where there is none within a tenth of its interval.
[[nodiscard]] std::optional<std::size_t> frame_at(const std::vector<Seconds>& times, Seconds time);

/// The wet cells of a run's frames. Several runs are compared with one reference, whose frames are
/// then read once for each size of cells and not once for each run.
class WaterOfRun {
 public:
  /// The run must outlive this.
  explicit WaterOfRun(const Run& run) : run_(run), view_(run.physics, run.spacing) {}
  [[nodiscard]] const Run& run() const { return run_; }
  /// Of frame number `index`, for cells of that edge.
  [[nodiscard]] const std::vector<bool>& wet(std::size_t index, Metres cell);

 private:
  const Run& run_;
  FrameView view_;
  std::map<std::pair<std::size_t, double>, std::vector<bool>> known_;
};

/// The pattern of every frame. The overlap is left out where there is no reference, where it has
/// another dimension, and where it has no frame at that time.
class PatternObservable : public Observable {
 public:
  /// Both must outlive this; `reference` may be null.
  PatternObservable(const Run& run, WaterOfRun* reference);
  void look(FrameView& frame) override;
  [[nodiscard]] Findings findings() override { return {}; }
  [[nodiscard]] const PatternHistory& history() const { return history_; }

 private:
  const Run& run_;
  WaterOfRun* reference_;
  PatternHistory history_;
};

}  // namespace surge::compare
