#include "foam_cases/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "particle/case/case_json.hpp"
#include "particle/case/vectors.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::foam {

namespace {

void write_triangle(std::ostream& out, const Point& a, const Point& b, const Point& c) {
  const auto vertex = [&](const Point& x) {
    out << "      vertex " << number_text(x[0]) << ' ' << number_text(x[1]) << ' '
        << number_text(x[2]) << '\n';
  };
  const Point n = unit(cross(minus(b, a), minus(c, a)));
  out << "  facet normal " << number_text(n[0]) << ' ' << number_text(n[1]) << ' '
      << number_text(n[2]) << "\n    outer loop\n";
  vertex(a);
  vertex(b);
  vertex(c);
  out << "    endloop\n  endfacet\n";
}

/// A polygon as a prism across the mesh, far beyond it at both ends, where tips close it: of all
/// that is near the mesh only the sides count.
void write_prism(std::ostream& out, const FoamCase& c, const ClosedSurface& polygon) {
  double far = 0.0;
  for (std::size_t a = 0; a < 3; ++a) far += 2.0 * (c.mesh.upper(a) - c.mesh.lower(a));
  const double back = c.mesh.lower(2) - far, front = c.mesh.upper(2) + far;
  const Box& box = polygon.bounds();
  const Point middle{0.5 * (box.lower[0] + box.upper[0]), 0.5 * (box.lower[1] + box.upper[1]), 0.0};
  const auto at = [](const Point& x, double z) { return Point{x[0], x[1], z}; };
  for (const ClosedSurface::Facet& edge : polygon.facets()) {
    const Point &a = polygon.vertices()[edge[0]], &b = polygon.vertices()[edge[1]];
    write_triangle(out, at(a, back), at(b, back), at(b, front));
    write_triangle(out, at(a, back), at(b, front), at(a, front));
    write_triangle(out, at(a, front), at(b, front), at(middle, front + far));
    write_triangle(out, at(b, back), at(a, back), at(middle, back - far));
  }
}

std::string stl_text(const FoamCase& c, std::size_t number) {
  const ClosedSurface& surface = *c.flow.obstacles[number].surface;
  const std::string name = obstacle_name(number);
  std::ostringstream out;
  out << "solid " << name << '\n';
  if (surface.dimension() == 2) {
    write_prism(out, c, surface);
  } else {
    for (const ClosedSurface::Facet& f : surface.facets())
      write_triangle(out, surface.vertices()[f[0]], surface.vertices()[f[1]],
                     surface.vertices()[f[2]]);
  }
  out << "endsolid " << name << '\n';
  return out.str();
}

std::string cut_text(const FoamCase& c, std::size_t number) {
  const std::string name = obstacle_name(number);
  Point outside{};  // is asked for, and not looked at where the surface says what is outside
  for (std::size_t a = 0; a < 3; ++a) outside[a] = c.mesh.lower(a) - 1.0;
  return header("dictionary", "cutDict." + name) + "\n// The cells whose middles are not in " +
         name +
         ": subsetMesh keeps them, with what they\n// have in common with the others as the "
         "patch " +
         name + ".\nactions\n(\n    {\n        name            outside" + name +
         ";\n        type            cellSet;\n        action          new;\n"
         "        source          surfaceToCell;\n        file            "
         "\"constant/triSurface/" +
         name + ".stl\";\n        useSurfaceOrientation true;\n        outsidePoints   ( " +
         vector_text(outside) +
         " );\n        includeCut      false;\n        includeInside   false;\n"
         "        includeOutside  true;\n        nearDistance    -1;\n        curvature       "
         "-100;\n    }\n);\n";
}

/// Volume that surfaces take from the boxes of water.
double cut_from_water(const Case& c) {
  double sum = 0.0;
  for (const FluidBlock& block : c.blocks) {
    double volume = 1.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.dimension); ++a)
      volume *= block.box.upper[a] - block.box.lower[a];
    for (const Obstacle& obstacle : c.obstacles)
      if (obstacle.surface && block.shape == FluidBlock::Shape::box)
        sum += volume * obstacle.surface->share_of(block.box);
  }
  return sum;
}

/// Middle of the cell that holds a place, or that is nearest to it; of two that share it the upper
/// one. In 2D z is zero.
Point cell_middle(const FoamCase& c, const Point& x) {
  Point middle{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(c.flow.dimension); ++a) {
    const double off = 1e-3 * c.mesh.cell;
    const double in = std::clamp(x[a] + off, c.mesh.lower(a) + off, c.mesh.upper(a) - off);
    const auto faces = c.mesh.cell_around(a, in);
    middle[a] = 0.5 * (faces[0] + faces[1]);
  }
  return middle;
}

}  // namespace

bool has_surfaces(const Case& c) {
  return std::any_of(c.obstacles.begin(), c.obstacles.end(),
                     [](const Obstacle& obstacle) { return obstacle.surface != nullptr; });
}

Files surface_files(const FoamCase& c) {
  Files files;
  if (!has_surfaces(c.flow)) return files;
  for (std::size_t i = 0; i < c.flow.obstacles.size(); ++i) {
    if (!c.flow.obstacles[i].surface) continue;
    files["constant/triSurface/" + obstacle_name(i) + ".stl"] = stl_text(c, i);
    files["system/cutDict." + obstacle_name(i)] = cut_text(c, i);
  }
  const nlohmann::json stated{{"obstacles", surge::to_json(c.flow).at("obstacles")},
                              {"cut_from_water", cut_from_water(c.flow)}};
  files["constant/obstacles.json"] = stated.dump(1) + "\n";
  return files;
}

bool is_cut(const FoamCase& c, const Point& x) {
  const Point middle = cell_middle(c, x);
  return std::any_of(c.flow.obstacles.begin(), c.flow.obstacles.end(),
                     [&](const Obstacle& obstacle) {
                       return obstacle.surface != nullptr && obstacle.surface->holds(middle);
                     });
}

Point in_remaining_cell(const FoamCase& c, const Point& x, const std::string& what) {
  if (!is_cut(c, x)) return x;
  const auto axes = static_cast<std::size_t>(c.flow.dimension);
  Point flat = x;
  if (axes == 2) flat[2] = 0.0;
  const ClosedSurface* nearest = nullptr;
  for (const Obstacle& obstacle : c.flow.obstacles)
    if (obstacle.surface && (nearest == nullptr || std::abs(obstacle.surface->distance(flat)) <
                                                       std::abs(nearest->distance(flat))))
      nearest = obstacle.surface.get();
  const Point n = nearest->facet_normal(nearest->nearest(flat).facet);
  for (int step = 1; step <= 20; ++step) {
    Point place = cell_middle(c, plus(x, 0.25 * step * c.mesh.cell, n));
    if (is_cut(c, place)) continue;
    if (axes == 2) place[2] = x[2];
    return place;
  }
  throw Error(what +
              ": found no cell of the mesh within five cells of it, expected a finer mesh or "
              "another place");
}

}  // namespace surge::foam
