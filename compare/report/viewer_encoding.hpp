#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "compare/figures/water.hpp"

namespace surge::compare {

/// Interval that quantised numbers lie in.
struct Interval {
  double lower = 0.0;
  double upper = 1.0;
};

/// Nearest of the 2^16 equidistant numbers of the interval, its ends included; what lies outside
/// or is not finite becomes an end. The error inside is at most (upper - lower)/131070.
[[nodiscard]] std::uint16_t quantise(double value, Interval interval);
[[nodiscard]] double restored(std::uint16_t value, Interval interval);
/// The same for 0..1 in 2^8 steps.
[[nodiscard]] std::uint8_t quantise_unit(double value);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

/// The water of a mesh on squares of the given edge (over L) whose corners are multiples of it:
/// fractions are means over the square; pressure and speed are means over its water. Squares with
/// less than 2 % of water are left out, as a drawing of them would only tint the air.
[[nodiscard]] std::vector<WaterPatch> coarse_cells(const std::vector<WaterPatch>& cells,
                                                   double edge);

/// Water of one run at a sequence of times, in the few bytes that the viewer needs.
class WaterTrack {
 public:
  /// `mesh` adds the volume fraction to each patch.
  explicit WaterTrack(bool mesh) : mesh_(mesh) {}

  /// One more time; empty where the run has no frame there.
  void add(const std::vector<WaterPatch>& patches);

  /// {"mesh", "half": half the edge of a square or the radius of a particle, "x": [lower, upper],
  /// "y": [..], "counts": [patches per time], "data": base64}. The data hold one plane behind the
  /// other, each for all times: x and y (16 bit, little endian, in their intervals), p/(rho g H)
  /// and |u|/sqrt(2gH) (8 bit, 0..1, clamped), on a mesh the volume fraction (8 bit).
  [[nodiscard]] nlohmann::json encoded() const;

 private:
  bool mesh_;
  double half_ = 0.0;
  std::vector<std::size_t> counts_;
  std::vector<float> x_, y_;
  std::vector<std::uint8_t> pressure_, speed_, fraction_;
};

/// The line alpha = 0.5 at a sequence of times.
class SurfaceTrack {
 public:
  void add(const std::vector<Segment>& segments);
  /// {"x", "y", "counts", "data"} as above, with the planes x0, y0, x1, y1 (16 bit).
  [[nodiscard]] nlohmann::json encoded() const;

 private:
  std::vector<std::size_t> counts_;
  std::vector<Segment> segments_;
};

}  // namespace surge::compare
