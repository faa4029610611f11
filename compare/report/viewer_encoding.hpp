#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/figures/water.hpp"
#include "compare/report/viewer_pack.hpp"

namespace surge::compare {

/// Lengths are kept in steps of this part of a run's spacing: what is drawn is off by at most half
/// of it, 1/128 of the spacing, in each direction.
inline constexpr double steps_per_spacing = 64.0;

/// The water of a mesh on squares (in 3D: cubes) of the given edge (over L) whose corners are
/// multiples of it: fractions are means over the square; pressure and speed are means over its
/// water. Squares with less than 2 % of water are left out, as a drawing of them would only tint
/// the air.
[[nodiscard]] std::vector<WaterPatch> coarse_cells(const std::vector<WaterPatch>& cells,
                                                   double edge);

/// Of no patch at all.
inline constexpr std::array<double, 2> no_span{std::numeric_limits<double>::infinity(),
                                               -std::numeric_limits<double>::infinity()};

/// Which of a track's values its files hold: all of them at all times.
struct KnownValues {
  bool pressure = true, speed = true;
  bool start = true;  ///< pressure at the first time
  void look(const WaterPatch& patch, bool first);
  [[nodiscard]] nlohmann::json encoded() const;
};

/// Particles of one run at a sequence of times, in few bytes. Particles have no names, and solvers
/// may change their order: each is taken for the one that was nearest to where the last two times
/// put it, which keeps the changes small and is seen by nobody.
class ParticleTrack {
 public:
  /// `spacing` over L; `dimension` 2 or 3.
  ParticleTrack(double spacing, int dimension);

  /// One more time; empty where the run has no frame there.
  void add(const std::vector<WaterPatch>& patches);
  [[nodiscard]] std::array<double, 2> span() const { return span_; }  ///< least and most x

  /// {"mesh": false, "dimension", "half": radius, "step", "counts": particles per time, "known",
  /// "sizes", "data"}. Streams: which particles of the time before are gone (how many, then the
  /// first, then the distances between them); x, y and in 3D z in steps, less the place that the
  /// last two times lead to (of new particles, the place of the one before it); p/(rho g H) and
  /// |u|/sqrt(2gH) in 1/255, clamped to 0..1, less the value before, modulo 256. New particles
  /// stand behind the others.
  [[nodiscard]] nlohmann::json encoded() const;

 private:
  using Place = std::array<std::int32_t, 3>;
  struct Held {
    Place at{}, moved{};
    std::uint8_t pressure = 0, speed = 0;
  };
  /// For each of held_ the patch that it has become, -1 where it is gone.
  [[nodiscard]] std::vector<long> followed(const std::vector<Place>& places) const;
  void put(Held& held, const Place& expected, const Place& place, const WaterPatch& patch);

  double half_, step_;
  std::size_t axes_;
  std::vector<std::size_t> counts_;
  std::vector<Held> held_;
  ByteStream gone_, pressure_, speed_;
  std::array<ByteStream, 3> places_;
  std::array<double, 2> span_{no_span};
  KnownValues known_;
};

/// Water of a mesh on squares or cubes at a sequence of times.
class MeshTrack {
 public:
  /// `edge` over L; `dimension` 2 or 3.
  MeshTrack(double edge, int dimension) : edge_(edge), dimension_(dimension) {}

  /// Squares as coarse_cells() makes them.
  void add(const std::vector<WaterPatch>& squares);
  [[nodiscard]] std::array<double, 2> span() const { return span_; }  ///< least and most x

  /// {"mesh": true, "dimension", "half": half the edge, "first": numbers of the first square along
  /// each axis (0 begins at 0), "size": squares along each axis, "times", "known", "sizes",
  /// "data"}. Streams: volume fraction (0: none), pressure and speed of all squares, the first axis
  /// fastest, as above less the values of the time before, modulo 256.
  [[nodiscard]] nlohmann::json encoded() const;

 private:
  struct Square {
    std::array<long, 3> at;
    std::array<std::uint8_t, 3> values;
  };
  double edge_;
  int dimension_;
  std::vector<std::vector<Square>> times_;
  std::array<double, 2> span_{no_span};
  KnownValues known_;
};

/// The line of the free surface at a sequence of times.
class SurfaceTrack {
 public:
  /// `spacing` over L, as of a ParticleTrack.
  explicit SurfaceTrack(double spacing) : step_(spacing / steps_per_spacing) {}
  void add(const std::vector<Segment>& segments);
  /// {"step", "times", "sizes", "data"}. Streams: for each time the number of lines, for each line
  /// that of its points; x and y of the points in steps, less those of the point before in the
  /// stream.
  [[nodiscard]] nlohmann::json encoded() const;

 private:
  double step_;
  std::size_t times_ = 0;
  std::array<std::int32_t, 2> before_{0, 0};
  ByteStream counts_, x_, y_;
};

}  // namespace surge::compare
