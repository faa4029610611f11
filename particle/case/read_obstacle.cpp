#include "particle/case/read_obstacle.hpp"

#include <algorithm>
#include <cmath>

#include "particle/case/enum_names.hpp"
#include "particle/case/stl_file.hpp"
#include "particle/case/surface_checks.hpp"
#include "particle/case/tank_shape.hpp"

namespace surge {

namespace {

std::vector<Point> read_points(const TomlTable& table, std::string_view key,
                               std::size_t dimension) {
  std::vector<Point> points;
  for (const auto& row : table.matrix(key, {}, dimension)) {
    Point x{};
    std::copy(row.begin(), row.end(), x.begin());
    points.push_back(x);
  }
  return points;
}

std::vector<ClosedSurface::Facet> read_triangles(const TomlTable& table, std::size_t vertices) {
  std::vector<ClosedSurface::Facet> facets;
  for (const auto& row : table.matrix("triangles", {}, 3)) {
    ClosedSurface::Facet facet{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(row[k] >= 0.0 && row[k] < static_cast<double>(vertices)) ||
          row[k] != std::floor(row[k]))
        throw table.error("triangles", number_text(row[k]),
                          "numbers of vertices, 0 to " + std::to_string(vertices) + " excluded");
      facet[k] = static_cast<std::uint32_t>(row[k]);
    }
    if (facet[0] == facet[1] || facet[1] == facet[2] || facet[2] == facet[0])
      throw table.error("triangles", "a triangle with one corner twice", "three corners");
    facets.push_back(facet);
  }
  return facets;
}

ClosedSurface surface_of(const TomlTable& table, const std::string& key) {
  if (key == "polygon") return ClosedSurface::polygon(read_points(table, key, 2));
  if (key == "stl")
    return read_stl(table.folder() / table.text("stl"),
                    table.number_or("scale", 1.0, Bounds::above(0.0)));
  std::vector<Point> vertices = read_points(table, "vertices", 3);
  std::vector<ClosedSurface::Facet> facets = read_triangles(table, vertices.size());
  return ClosedSurface::triangles(std::move(vertices), std::move(facets));
}

Point read_corner(const TomlTable& table, std::string_view key, std::size_t dimension) {
  const std::vector<double> values = table.numbers(key, dimension);
  Point x{};
  std::copy(values.begin(), values.end(), x.begin());
  return x;
}

/// Whether an edge of a polygon lies on a side of a box. Surfaces in space reach none.
bool reaches(const ClosedSurface& room, const Box& box, std::size_t side) {
  const std::size_t axis = side / 2;
  const double at = side % 2 == 0 ? box.lower[axis] : box.upper[axis];
  const auto on_side = [&](std::size_t corner) {
    return std::abs(room.vertices()[corner][axis] - at) <=
           1e-9 * (box.upper[axis] - box.lower[axis]);
  };
  return room.dimension() == 2 &&
         std::any_of(room.facets().begin(), room.facets().end(),
                     [&](const auto& edge) { return on_side(edge[0]) && on_side(edge[1]); });
}

}  // namespace

std::optional<ClosedSurface> read_surface(const TomlTable& table, int dimension) {
  std::string kind;
  for (const char* key : {"polygon", "stl", "vertices"}) {
    if (!table.has(key)) continue;
    if (!kind.empty())
      throw table.error(key, "another body besides",
                        "one of polygon, stl, and vertices with triangles");
    kind = key;
  }
  if (kind != "stl" && table.has("scale"))
    throw table.error("scale", "no stl", "an STL file, whose unit it is");
  if (kind != "vertices" && table.has("triangles"))
    throw table.error("triangles", "no vertices", "vertices, which they join");
  if (kind.empty()) return std::nullopt;
  if ((kind == "polygon") != (dimension == 2))
    throw table.error(
        kind, "in " + std::to_string(dimension) + "D",
        dimension == 2 ? "a box or a polygon" : "a box, stl, or vertices and triangles");
  try {
    return surface_of(table, kind);
  } catch (const Error& error) {
    // What reads another file or a key has said where; the surface itself does not know.
    const std::string what = error.what();
    if (what.starts_with("found ")) throw Error(table.place(kind) + ": " + what);
    throw;
  }
}

Obstacle read_obstacle(const TomlTable& table, int dimension) {
  std::optional<ClosedSurface> surface = read_surface(table, dimension);
  if (surface) {
    if (table.has("lower") || table.has("upper"))
      throw table.error(place_key(table), "another body besides",
                        "a box (lower and upper), or one of polygon, stl, and vertices with "
                        "triangles");
    return Obstacle(std::move(*surface));
  }
  const auto axes = static_cast<std::size_t>(dimension);
  return {read_corner(table, "lower", axes), read_corner(table, "upper", axes)};
}

std::vector<Obstacle> read_room(const TomlTable& table, int dimension, Tank& tank) {
  const std::optional<ClosedSurface> room = read_surface(table, dimension);
  if (!room) return {};
  const std::string key = place_key(table);
  if (dimension == 2 && !table.has("lower") && !table.has("upper")) tank.box = room->bounds();
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
    if (tank.periodic[a])
      throw table.error("periodic", "a room of its own shape besides", "one of the two");
  for (std::size_t side = 0; side < 6; ++side)
    if (tank.open[side] && !reaches(*room, tank.box, side))
      throw table.error("open",
                        '"' + std::string(side_names[side]) + "\", on which the room has no edge",
                        dimension == 2 ? "a room that reaches the open side"
                                       : "none in 3D: the room may end high above the water");
  std::vector<Obstacle> made;
  try {
    for (ClosedSurface& body : bodies_around(*room, tank.box)) made.emplace_back(std::move(body));
  } catch (const Error& error) {
    throw Error(table.place(key) + ": " + error.what());
  }
  return made;
}

}  // namespace surge
