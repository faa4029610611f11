#include "particle/case/read_obstacle.hpp"

#include <algorithm>
#include <cmath>

#include "particle/case/stl_file.hpp"

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

ClosedSurface read_surface(const TomlTable& table, const std::string& key) {
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

}  // namespace

Obstacle read_obstacle(const TomlTable& table, int dimension) {
  const auto axes = static_cast<std::size_t>(dimension);
  std::string kind;
  for (const char* key : {"polygon", "stl", "vertices"}) {
    if (!table.has(key)) continue;
    if (!kind.empty() || table.has("lower") || table.has("upper"))
      throw table.error(key, "another body besides",
                        "a box (lower and upper), or one of polygon, stl, and vertices with "
                        "triangles");
    kind = key;
  }
  if (kind != "stl" && table.has("scale"))
    throw table.error("scale", "no stl", "an STL file, whose unit it is");
  if (kind != "vertices" && table.has("triangles"))
    throw table.error("triangles", "no vertices", "vertices, which they join");
  if (kind.empty()) return {read_corner(table, "lower", axes), read_corner(table, "upper", axes)};
  if ((kind == "polygon") != (dimension == 2))
    throw table.error(
        kind, "in " + std::to_string(dimension) + "D",
        dimension == 2 ? "a box or a polygon" : "a box, stl, or vertices and triangles");
  try {
    return Obstacle(read_surface(table, kind));
  } catch (const Error& error) {
    // What reads another file or a key has said where; the surface itself does not know.
    const std::string what = error.what();
    if (what.starts_with("found ")) throw Error(table.place(kind) + ": " + what);
    throw;
  }
}

}  // namespace surge
