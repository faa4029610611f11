#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "particle/case/case.hpp"

namespace surge {

/// A stretch along an axis on which something is thinner than it must be.
struct ThinPlace {
  std::size_t axis = 0;
  double thickness = 0.0;  ///< m
  bool gap = false;        ///< space between solids; else solid between spaces
  /// What bounds a gap from below, or what the wall is made of: an index of an obstacle, or of a
  /// moving wall after those; none for a wall of the tank.
  std::optional<std::size_t> solid;
};

/// The space of a case cut by all faces of its solids into cells that are solid or open, whatever
/// the spacing: what bodies that touch make together, and where water can get to.
class SolidCells {
 public:
  /// Number of cells that a case makes: no more than `most_cells` are worth the time.
  [[nodiscard]] static double cell_count(const Case& c);
  static constexpr double most_cells = 4e6;

  explicit SolidCells(const Case& c);

  /// The first solid stretch thinner than `radius` (m) that has space which water can get to on
  /// both of its sides. What stands against a wall of the tank has one side.
  [[nodiscard]] std::optional<ThinPlace> thin_wall(double radius) const;
  /// The first space between solids that is narrower than `width` (m).
  [[nodiscard]] std::optional<ThinPlace> narrow_gap(double width) const;

 private:
  static constexpr std::size_t open = static_cast<std::size_t>(-1);
  using Cell = std::array<std::size_t, 3>;

  [[nodiscard]] std::size_t index(const Cell& cell) const {
    return cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]);
  }
  [[nodiscard]] Cell cell(std::size_t index) const {
    return {index % count_[0], index / count_[0] % count_[1], index / count_[0] / count_[1]};
  }
  [[nodiscard]] double width(std::size_t axis, std::size_t k) const {
    return edges_[axis][k + 1] - edges_[axis][k];
  }
  /// The next cell up or down an axis; none beyond the walls of the tank.
  [[nodiscard]] std::optional<std::size_t> next(std::size_t at, std::size_t axis, bool up) const;
  [[nodiscard]] bool is_wall(std::size_t at) const { return solid_[at] != open; }
  void mark_wet(const Case& c);
  /// Calls f(cell) for all cells whose middle lies in a box.
  template <class F>
  void for_each_inside(const Box& box, F&& f) const;
  template <class Inside, class Ends>
  [[nodiscard]] std::optional<ThinPlace> thin_stretch(double least, bool gap, Inside&& inside,
                                                      Ends&& ends) const;

  std::array<std::vector<double>, 3> edges_;  ///< m, of the cells along each axis
  std::array<std::size_t, 3> count_{1, 1, 1};
  std::array<bool, 3> periodic_{};
  std::array<bool, 6> open_{};  ///< sides of the tank, all of them where there is none
  std::size_t dimension_;
  std::vector<std::size_t> solid_;  ///< which solid fills a cell
  std::vector<bool> wet_;           ///< water can get to the cell
};

}  // namespace surge
