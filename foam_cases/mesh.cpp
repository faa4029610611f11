#include "foam_cases/mesh.hpp"

#include <algorithm>
#include <cmath>

#include "foam_cases/divisions.hpp"
#include "particle/case/enum_names.hpp"
#include "particle/case/scales.hpp"
#include "particle/support/count.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

constexpr double most_cells = 2e9;  ///< OpenFOAM of Debian numbers them in 32 bits
constexpr std::size_t most_squares = 100;
constexpr double least_coarse = 2.0;  ///< L: less is not worth a zone of its own

/// Size of the last cell over that of the first of `cells` cells in geometric progression, so that
/// they fill `extent` first cells. By bisection.
double expansion_that_fills(double extent, double cells) {
  const auto filled = [&](double expansion) {
    const double ratio = std::pow(expansion, 1.0 / (cells - 1.0));
    return std::abs(ratio - 1.0) < 1e-12 ? cells : (std::pow(ratio, cells) - 1.0) / (ratio - 1.0);
  };
  double low = 1.0, high = 2.0;
  while (filled(high) < extent) high *= 2.0;
  for (int i = 0; i < 200; ++i)
    (filled(0.5 * (low + high)) < extent ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

class Builder {
 public:
  Builder(const Case& c, const Settings& settings)
      : case_(c), settings_(settings), dimension_(static_cast<std::size_t>(c.dimension)) {
    mesh_.length = settings.length;
    mesh_.cell = settings.length / static_cast<double>(settings.cells_per_length);
    find_up();
  }

  Mesh build() {
    for (std::size_t a = 0; a < 3; ++a) mesh_.axes[a] = axis(a);
    if (!(mesh_.cells() <= most_cells)) {
      throw Error("--foam cellsPerL: found " + number_text(mesh_.cells()) +
                  " cells, expected at most " + number_text(most_cells));
    }
    cut_into_squares();
    mark_solid();
    return mesh_;
  }

 private:
  void find_up() {
    double largest = 0.0;
    mesh_.up = 1;
    for (std::size_t a = 0; a < dimension_; ++a) {
      if (std::abs(case_.gravity[a]) <= largest) continue;
      largest = std::abs(case_.gravity[a]);
      mesh_.up = a;
      mesh_.up_is_plus = case_.gravity[a] < 0.0;
    }
  }

  /// Calls f(lower, upper, what) for the extents along an axis of what must end on cell faces.
  template <class F>
  void for_each_body(std::size_t a, F&& f) const {
    for (std::size_t i = 0; i < case_.blocks.size(); ++i) {
      if (case_.blocks[i].shape == FluidBlock::Shape::box)
        f(case_.blocks[i].box.lower[a], case_.blocks[i].box.upper[a], "block." + std::to_string(i));
    }
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i)
      if (!case_.obstacles[i].surface)  // cells are cut out of the mesh afterwards
        f(case_.obstacles[i].lower[a], case_.obstacles[i].upper[a],
          "obstacle." + std::to_string(i));
    for (const MovingWall& wall : case_.moving_walls)
      f(wall.box.lower[a], wall.box.upper[a], wall.name);
  }

  /// Faces along an axis in increasing order, those of the tank first and last.
  [[nodiscard]] std::vector<Face> faces(std::size_t a) const {
    const Box& tank = case_.tank.box;
    std::vector<Face> found{{tank.lower[a], "tank"}, {tank.upper[a], "tank"}};
    const auto add = [&](double x, const std::string& what) {
      const bool there = std::any_of(found.begin(), found.end(), [&](const Face& face) {
        return std::abs(face.place - x) <= 1e-6 * mesh_.cell;
      });
      if (!there) found.push_back({x, what});
    };
    for_each_body(a, [&](double lower, double upper, const std::string& what) {
      add(lower, what + ".lower");
      add(upper, what + ".upper");
    });
    std::sort(found.begin(), found.end(),
              [](const Face& l, const Face& r) { return l.place < r.place; });
    return found;
  }

  [[nodiscard]] Axis axis(std::size_t a) const {
    if (a >= dimension_) return {{0.0, mesh_.length, 1, 1.0}};
    Axis pieces;
    std::vector<Face> all = faces(a);
    const std::optional<double> coarse = a == mesh_.up ? coarse_from() : std::nullopt;
    // A wall that moves may end just there.
    const auto last = mesh_.up_is_plus ? all.end() - 1 : all.begin() + 1;
    const Face& inner = mesh_.up_is_plus ? *(last - 1) : *last;
    if (coarse && std::abs(inner.place - *coarse) > 1e-6 * mesh_.cell)
      all.insert(last, {*coarse, "coarse"});
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      const bool grows = coarse && (mesh_.up_is_plus ? i + 2 == all.size() : i == 0);
      pieces.push_back(grows ? grown(all[i].place, all[i + 1].place) : even(a, all[i], all[i + 1]));
    }
    return pieces;
  }

  [[nodiscard]] Piece even(std::size_t a, const Face& from, const Face& to) const {
    const auto count = whole_cells(to.place - from.place, mesh_.cell);
    if (!count) {
      const std::vector<double> all = stretches();
      throw Error(division_error(axis_names[a], from, to, settings_.length,
                                 settings_.cells_per_length, all));
    }
    return {from.place, to.place, whole_number(*count, "cells", most_cells), 1.0};
  }

  /// As many cells as L has. How they grow does not depend on their number, so that meshes of
  /// different resolution are alike.
  [[nodiscard]] Piece grown(double from, double to) const {
    constexpr double cells = 20.0;
    const double extent = (to - from) / mesh_.length * cells;
    const double expansion = std::max(1.0, std::round(expansion_that_fills(extent, cells)));
    return {from, to, settings_.cells_per_length, mesh_.up_is_plus ? expansion : 1.0 / expansion};
  }

  /// Where the zone begins in which cells grow, towards the side that gravity points away from;
  /// none where the tank is not that high, or holds something there.
  [[nodiscard]] std::optional<double> coarse_from() const {
    const std::size_t a = mesh_.up;
    if (case_.tank.periodic[a] || settings_.coarse_above <= 0.0) return std::nullopt;
    const double sign = mesh_.up_is_plus ? 1.0 : -1.0;
    const Box& tank = case_.tank.box;
    const double floor = mesh_.up_is_plus ? tank.lower[a] : tank.upper[a];
    const double height = tank.upper[a] - tank.lower[a];
    const double cells = std::ceil(settings_.coarse_above * mesh_.length / mesh_.cell - 1e-6);
    const double begin = cells * mesh_.cell;
    if (!(height - begin >= least_coarse * mesh_.length * (1.0 - 1e-9))) return std::nullopt;
    double highest = 0.0;
    const auto add = [&](double lower, double upper) {
      highest = std::max(highest, mesh_.up_is_plus ? upper - floor : floor - lower);
    };
    for (const FluidBlock& block : case_.blocks) add(block.box.lower[a], block.box.upper[a]);
    for (const Box& box : case_.obstacles) add(box.lower[a], box.upper[a]);
    if (highest > begin * (1.0 - 1e-9)) return std::nullopt;
    highest = 0.0;
    for (const MovingWall& wall : case_.moving_walls) add(wall.box.lower[a], wall.box.upper[a]);
    if (highest > begin + 1e-6 * mesh_.cell) return std::nullopt;
    return floor + sign * begin;
  }

  /// Lengths that cells of one size must divide: between the faces along each axis.
  [[nodiscard]] std::vector<double> stretches() const {
    std::vector<double> lengths;
    for (std::size_t a = 0; a < dimension_; ++a) {
      const std::vector<Face> all = faces(a);
      std::size_t last = all.size() - 1, first = 0;
      if (a == mesh_.up && coarse_from()) mesh_.up_is_plus ? --last : ++first;
      for (std::size_t i = first; i < last; ++i) lengths.push_back(all[i + 1].place - all[i].place);
    }
    return lengths;
  }

  /// Cuts pieces into squares of side L where all of them are made of such, and they are few.
  void cut_into_squares() {
    std::array<Axis, 3> cut;
    std::size_t squares = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      for (const Piece& piece : mesh_.axes[a]) {
        const double parts = std::round((piece.to - piece.from) / mesh_.length);
        const double first = piece.from / mesh_.length;
        const bool single = piece.expansion != 1.0 || a >= dimension_;
        const bool fits = whole_cells(piece.to - piece.from, mesh_.length) &&
                          std::abs(first - std::round(first)) < 1e-9;
        if (!fits || parts > most_squares) return;
        const auto count = single ? 1L : std::lround(parts);
        for (long i = 0; i < count; ++i) {
          Piece part = piece;
          if (!single) part.cells = settings_.cells_per_length;
          part.from = (std::round(first) + static_cast<double>(i)) * mesh_.length;
          part.to = single ? piece.to : part.from + mesh_.length;
          cut[a].push_back(part);
        }
      }
      squares *= cut[a].size();
    }
    if (squares > most_squares) return;
    mesh_.axes = cut;
    mesh_.squares = true;
  }

  void mark_solid() {
    mesh_.solid.assign(mesh_.count(0) * mesh_.count(1) * mesh_.count(2), false);
    mesh_.for_each_place([&](const Place& place) {
      const Point x = mesh_.middle(place);
      for (const Obstacle& box : case_.obstacles) {
        bool inside = !box.surface;
        for (std::size_t a = 0; a < dimension_; ++a)
          inside = inside && x[a] > box.lower[a] && x[a] < box.upper[a];
        if (inside) mesh_.solid[mesh_.index(place)] = true;
      }
    });
  }

  const Case& case_;
  const Settings& settings_;
  std::size_t dimension_;
  Mesh mesh_;
};

}  // namespace

std::optional<Place> Mesh::next(Place place, std::size_t axis, bool plus) const {
  if (plus ? place[axis] + 1 >= count(axis) : place[axis] == 0) return std::nullopt;
  plus ? ++place[axis] : --place[axis];
  return place;
}

double Mesh::cells_along(std::size_t axis) const {
  double sum = 0.0;
  for (const Piece& piece : axes[axis]) sum += static_cast<double>(piece.cells);
  return sum;
}

double Mesh::cells() const {
  if (solid.empty()) return cells_along(0) * cells_along(1) * cells_along(2);
  double sum = 0.0;
  for_each_place([&](const Place& place) {
    if (is_solid(place)) return;
    double product = 1.0;
    for (std::size_t a = 0; a < 3; ++a) product *= static_cast<double>(axes[a][place[a]].cells);
    sum += product;
  });
  return sum;
}

std::array<double, 2> Mesh::cell_around(std::size_t axis, double x) const {
  double low = upper(axis), high = lower(axis);
  for (const Piece& piece : axes[axis]) {
    const auto n = static_cast<double>(piece.cells);
    const double ratio = piece.cells > 1 ? std::pow(piece.expansion, 1.0 / (n - 1.0)) : 1.0;
    double from = piece.from;
    double size = std::abs(ratio - 1.0) < 1e-12
                      ? (piece.to - piece.from) / n
                      : (piece.to - piece.from) * (ratio - 1.0) / (std::pow(ratio, n) - 1.0);
    for (long i = 0; i < piece.cells; ++i, from += size, size *= ratio) {
      const double slack = 1e-6 * size;
      if (x < from - slack || x > from + size + slack) continue;
      low = std::min(low, from);
      high = std::max(high, from + size);
    }
  }
  return {low, high};
}

Mesh make_mesh(const Case& c, const Settings& settings) {
  return Builder(c, settings).build();
}

Box in_three_dimensions(const Case& c, const Mesh& mesh, Box box) {
  if (c.dimension == 2) {
    box.lower[2] = mesh.lower(2);
    box.upper[2] = mesh.upper(2);
  }
  return box;
}

}  // namespace surge::foam
