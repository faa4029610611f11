#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "foam_cases/settings.hpp"
#include "particle/case/case.hpp"

namespace surge::foam {

/// A stretch of an axis between two faces of bodies, with its cells.
struct Piece {
  double from = 0.0;  ///< m
  double to = 0.0;    ///< m
  long cells = 1;
  double expansion = 1.0;  ///< size of the last cell over that of the first

  [[nodiscard]] double middle() const { return 0.5 * (from + to); }
};
using Axis = std::vector<Piece>;

/// Where one piece of each axis meets: a block of cells, or part of an obstacle.
using Place = std::array<std::size_t, 3>;

/// The mesh of a case: a box of pieces along x, y and z, without those that obstacles fill. All
/// faces of tank, boxes of water and obstacles are faces of cells. In 2D one cell of thickness L.
struct Mesh {
  std::array<Axis, 3> axes;
  /// All pieces are squares (cubes) of side L: the numbers of cells follow from cellsPerL.
  bool squares = false;
  double length = 0.0;      ///< L, m
  double cell = 0.0;        ///< m, of a cell where none has grown
  std::size_t up = 1;       ///< axis opposite to gravity, or along it
  bool up_is_plus = true;   ///< whether gravity points to its lower side
  std::vector<bool> solid;  ///< by index()

  [[nodiscard]] std::size_t count(std::size_t axis) const { return axes[axis].size(); }
  [[nodiscard]] std::size_t index(const Place& place) const {
    return place[0] + count(0) * (place[1] + count(1) * place[2]);
  }
  [[nodiscard]] bool is_solid(const Place& place) const { return solid[index(place)]; }
  [[nodiscard]] Point middle(const Place& place) const {
    return {axes[0][place[0]].middle(), axes[1][place[1]].middle(), axes[2][place[2]].middle()};
  }
  [[nodiscard]] double lower(std::size_t axis) const { return axes[axis].front().from; }
  [[nodiscard]] double upper(std::size_t axis) const { return axes[axis].back().to; }
  /// The next place along an axis; none beyond the sides of the tank, periodic or not.
  [[nodiscard]] std::optional<Place> next(Place place, std::size_t axis, bool plus) const;
  /// Number of cells, of the whole mesh or along an axis; a double, as it may be too large.
  [[nodiscard]] double cells() const;
  [[nodiscard]] double cells_along(std::size_t axis) const;
  /// Faces of the cell that holds a coordinate (m), or of both where it lies on a face.
  [[nodiscard]] std::array<double, 2> cell_around(std::size_t axis, double x) const;
  /// Calls f(place) for all of them, x running fastest.
  template <class F>
  void for_each_place(F&& f) const {
    for (std::size_t k = 0; k < count(2); ++k)
      for (std::size_t j = 0; j < count(1); ++j)
        for (std::size_t i = 0; i < count(0); ++i) f(Place{i, j, k});
  }
};

/// The mesh of a case with a tank. Throws Error where cells of L/cellsPerL do not fit between the
/// faces of tank, boxes and obstacles, with the nearest numbers of cells that do; where obstacles
/// cut off a part of the tank; where there are more cells than can be numbered.
[[nodiscard]] Mesh make_mesh(const Case& c, const Settings& settings);

/// The coordinates of `box` that lie between those of the tank, as the mesh has them.
[[nodiscard]] Box in_three_dimensions(const Case& c, const Mesh& mesh, Box box);

}  // namespace surge::foam
