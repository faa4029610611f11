#pragma once

#include <cmath>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "compare/measure/frame_view.hpp"
#include "compare/read/run.hpp"
#include "compare/read/units.hpp"

namespace surge::compare {

/// A strip of particles holds at least so many spacings. Walls that push keep the lowest layer of a
/// fast, thin tongue off the floor: in the dam break with spacings of 5 mm the lowest centres of
/// SPH are 1.5 to 1.8 spacings above it (other presets: half a spacing), so that a strip of 1.5
/// spacings misses the tongue and tells where the water behind it lies. Strips of 2.5 spacings and
/// more give the same front. A mesh has no such gap: its lowest cells lie on the floor.
inline constexpr double least_strip_spacings = 3.0;

/// How the leading edge is measured: the same on both sides.
struct FrontOptions {
  /// Only water up to this height above the floor counts; the number belongs to the study. For
  /// particles it is least_strip_spacings where that is more.
  Metres strip_height{0.015};
  /// Particles closer than this many spacings belong together.
  double linking_length = usual_linking_length;
  /// Farthest water of all, drops that left the main body and water above the strip included.
  bool raw_maximum = false;
  /// Where water of depth d covers the floor from the start: the front is where the water stands
  /// higher than d + bed_share (H - d), H the height of the column.
  double bed_share = 0.1;
};

struct FrontSample {
  Seconds time;
  Metres position;  ///< of the leading edge, from the wall that the column stands at
};
using FrontHistory = std::vector<FrontSample>;

/// When something happened, known only as well as the frames are dense: linear between the frame
/// before and the one after it.
template <class Time>
struct Moment {
  Time time;
  Time before;
  Time after;
  /// Standard uncertainty of a time that may lie anywhere between the two frames (GUM 4.3.7).
  [[nodiscard]] double uncertainty() const { return (after - before).value() / std::sqrt(12.0); }
};

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
  /// The same with the samples before and after it.
  [[nodiscard]] std::optional<Moment<DimensionlessTime>> arrival_moment(
      DimensionlessLength level) const;
};

/// Heights between which the water of the main body counts for the front, m (the frame's own
/// coordinate): up to the strip's top over a dry floor, from the stated level on over a wet bed.
struct FrontStrip {
  double lower = 0.0;
  double upper = 0.0;
};
/// Throws surge::Error where the bed's share of the column is less than a spacing, which no run of
/// that spacing can tell from the bed, where the column's height is not known, or where
/// raw_maximum is asked for over a wet bed.
[[nodiscard]] FrontStrip front_strip(const Physics& physics, Metres spacing, bool particles,
                                     const FrontOptions& options);

/// x of the leading edge of one frame (m, the frame's own coordinate): the farthest x, seen from
/// the wall that the column stands at (Physics::surge_direction()), reached by water that is
/// connected to the main body within the strip. Particles: centre + l0/2 of those whose centre is
/// below the strip's top, over a wet bed whose upper side is above the level; connected by the
/// linking length. Mesh: the alpha = 0.5 contour of the corner values (means of the cells around),
/// connected through the mesh. The main body is the connected region with the most water. Over a
/// wet bed, water that hangs over counts as soon as it is the farthest. In 3D the front is that of
/// the farthest place across. Empty where no water is in the strip.
[[nodiscard]] std::optional<double> leading_edge(FrameView& view, const FrontOptions& options);

/// Its mesh part; `front_strip` is found by the caller.
[[nodiscard]] std::optional<double> mesh_leading_edge(FrameView& view, const FrontStrip& strip,
                                                      bool everything);

/// What a front must satisfy before it is used: the first frame shows the column, and the edge
/// moves as fast as falling water can. Throws surge::Error, which names the option that answers it.
void check_front_start(const Run& run, const FrontSample& first);
void check_front_speed(const Run& run, const FrontHistory& history);

/// Reads the frames of a run, one at a time, until one has no leading edge any more (a broken run):
/// the history is then shorter than run.frames->times(). Throws surge::Error where the first frame
/// has none.
[[nodiscard]] FrontHistory measure_front(Run& run, const FrontOptions& options);

/// The front by another choice of what defines it.
struct FrontVariant {
  std::string name;  ///< "strip_x2", "linking_1.5", "linking_2.5"; "bed_share_x2" over a wet bed
  FrontHistory history;
};
/// The front and, in the same pass over the frames, that of a strip of twice the height (twice the
/// share over a wet bed) and, of particles, of linking lengths half a spacing shorter and longer. A
/// variant that cannot be measured is left out with a notice.
struct FrontWithVariants {
  FrontHistory front;
  std::vector<FrontVariant> variants;
};
[[nodiscard]] FrontWithVariants measure_front_variants(Run& run, const FrontOptions& options);

[[nodiscard]] DimensionlessFront dimensionless(const FrontHistory& history, const Scales& scales);

/// Columns time_s,T,Z_over_L; T and Z/L to five decimals.
void write_front_csv(std::ostream& out, const FrontHistory& history, const Scales& scales);
void write_front_csv(const std::filesystem::path& file, const FrontHistory& history,
                     const Scales& scales);

}  // namespace surge::compare
