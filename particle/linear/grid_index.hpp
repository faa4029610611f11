#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace surge::linear {

/// Numbers the points of a box of a square (cubic) grid that are in use. A wrapped axis is
/// periodic.
template <int D>
class GridIndex {
 public:
  using Coordinate = std::array<std::int32_t, D>;

  /// `extent` points along each axis.
  void reset(const Coordinate& extent, const std::array<bool, D>& wrapped);
  /// The number of a point, a new one where it has none yet.
  std::int32_t add(Coordinate c);
  /// The number of a point, or -1: not in use, or outside.
  [[nodiscard]] std::int32_t find(Coordinate c) const;

  [[nodiscard]] const std::vector<Coordinate>& points() const { return points_; }
  [[nodiscard]] const Coordinate& extent() const { return extent_; }
  [[nodiscard]] const std::array<bool, D>& wrapped() const { return wrapped_; }

 private:
  [[nodiscard]] bool wrap(Coordinate& c) const;
  [[nodiscard]] std::size_t offset(const Coordinate& c) const;

  Coordinate extent_{};
  std::array<bool, D> wrapped_{};
  std::vector<std::int32_t> number_;
  std::vector<Coordinate> points_;
};

}  // namespace surge::linear
