#include <algorithm>
#include <map>

#include "particle/case/closed_surface.hpp"
#include "particle/case/vectors.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge {

namespace {

std::string place_text(const Point& x, int dimension) {
  std::string text = "(";
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
    text.append(a > 0 ? ", " : "").append(number_text(x[a]));
  return text.append(")");
}

/// Twice the area of a, b, c with the sign of their sense, in the plane.
double turn(const Point& a, const Point& b, const Point& c) {
  return cross(minus(b, a), minus(c, a))[2];
}

bool on_segment(const Point& a, const Point& b, const Point& x) {
  return std::min(a[0], b[0]) <= x[0] && x[0] <= std::max(a[0], b[0]) &&
         std::min(a[1], b[1]) <= x[1] && x[1] <= std::max(a[1], b[1]);
}

/// Whether two segments have a place in common.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double t1 = turn(a, b, c), t2 = turn(a, b, d), t3 = turn(c, d, a), t4 = turn(c, d, b);
  if (((t1 > 0.0 && t2 < 0.0) || (t1 < 0.0 && t2 > 0.0)) &&
      ((t3 > 0.0 && t4 < 0.0) || (t3 < 0.0 && t4 > 0.0)))
    return true;
  return (t1 == 0.0 && on_segment(a, b, c)) || (t2 == 0.0 && on_segment(a, b, d)) ||
         (t3 == 0.0 && on_segment(c, d, a)) || (t4 == 0.0 && on_segment(c, d, b));
}

/// Six times the volume of a tetrahedron, with the sign of its sense.
double sense(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(cross(minus(b, a), minus(c, a)), minus(d, a));
}

/// Whether the segment from p to q passes through the inside of a triangle.
bool pierces(const Point& p, const Point& q, const std::array<Point, 3>& t) {
  const double above = sense(t[0], t[1], t[2], p), below = sense(t[0], t[1], t[2], q);
  if (!((above > 0.0 && below < 0.0) || (above < 0.0 && below > 0.0))) return false;
  const double s0 = sense(p, q, t[0], t[1]), s1 = sense(p, q, t[1], t[2]),
               s2 = sense(p, q, t[2], t[0]);
  return (s0 > 0.0 && s1 > 0.0 && s2 > 0.0) || (s0 < 0.0 && s1 < 0.0 && s2 < 0.0);
}

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw Error("found " + found + ", expected " + expected);
}

/// Each edge once in each sense: closed, and all triangles face the same way.
void require_closed(const std::vector<Point>& vertices,
                    const std::vector<ClosedSurface::Facet>& facets) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const ClosedSurface::Facet& f : facets)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{f[k], f[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    const std::string where = " at the edge from " + place_text(vertices[edge.first], 3) + " to " +
                              place_text(vertices[edge.second], 3);
    const auto back = edges.find({edge.second, edge.first});
    if (count > 1)
      refuse("two triangles that face opposite ways, or more than two," + where,
             "two triangles at each edge that face the same way");
    if (back == edges.end())
      refuse("a surface that is open" + where,
             "a closed surface: two triangles at each edge, with the same corners to the last "
             "digit");
  }
}

}  // namespace

ClosedSurface ClosedSurface::polygon(std::vector<Point> corners) {
  const std::string simple = "the corners of a polygon in order, the first one not repeated";
  if (corners.size() < 3) refuse(std::to_string(corners.size()) + " corners", "at least 3");
  if (corners.size() > most_corners)
    refuse(std::to_string(corners.size()) + " corners", "at most " + std::to_string(most_corners));
  double area = 0.0;
  Box box{corners[0], corners[0]};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if (a == b) refuse("the corner " + place_text(a, 2) + " twice in a row", simple);
    area += 0.5 * cross(minus(a, corners[0]), minus(b, corners[0]))[2];
    for (std::size_t k = 0; k < 2; ++k) {
      box.lower[k] = std::min(box.lower[k], a[k]);
      box.upper[k] = std::max(box.upper[k], a[k]);
    }
  }
  const Point size = minus(box.upper, box.lower);
  if (area < 0.0) std::reverse(corners.begin(), corners.end());
  std::vector<Facet> edges;
  for (std::uint32_t i = 0; i < corners.size(); ++i)
    edges.push_back({i, static_cast<std::uint32_t>((i + 1) % corners.size()), 0});
  ClosedSurface made(2, std::move(corners), std::move(edges));
  made.require_simple();
  if (!(std::abs(area) > 1e-12 * (size[0] * size[0] + size[1] * size[1])))
    refuse("a polygon without area", "corners that are not all on one line");
  made.find_pseudonormals();
  return made;
}

ClosedSurface ClosedSurface::triangles(std::vector<Point> vertices, std::vector<Facet> facets) {
  if (facets.size() < 4) refuse(std::to_string(facets.size()) + " triangles", "at least 4");
  if (facets.size() > most_triangles)
    refuse(std::to_string(facets.size()) + " triangles",
           "at most " + std::to_string(most_triangles) + ", a coarser surface");
  Box box{vertices[0], vertices[0]};
  for (const Point& x : vertices) {
    for (std::size_t a = 0; a < 3; ++a) {
      box.lower[a] = std::min(box.lower[a], x[a]);
      box.upper[a] = std::max(box.upper[a], x[a]);
    }
  }
  const Point size = minus(box.upper, box.lower);
  const double scale = dot(size, size);
  require_closed(vertices, facets);
  ClosedSurface made(3, std::move(vertices), std::move(facets));
  for (std::size_t f = 0; f < made.facets_.size(); ++f)
    if (!(made.facet_size(f) > 1e-14 * scale))
      refuse("a triangle without area at " + place_text(made.vertices_[made.facets_[f][0]], 3),
             "triangles with three corners that are not on one line");
  if (!(std::abs(made.volume_) > 1e-15 * std::pow(scale, 1.5)))
    refuse("a surface without volume", "the surface of a body");
  if (made.volume_ < 0.0)
    refuse("triangles that face inwards (a volume of " + number_text(made.volume_) + " m3)",
           "corners that run against the clock as seen from outside");
  made.require_simple();
  made.find_pseudonormals();
  return made;
}

/// No two facets have a place in common but neighbours their corners and edges. Facets are met in
/// the order of their lower ends along x.
void ClosedSurface::require_simple() const {
  std::vector<Box> box;
  for (std::size_t f = 0; f < facets_.size(); ++f) box.push_back(box_of(f));
  std::vector<std::size_t> order(facets_.size());
  for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
  std::sort(order.begin(), order.end(),
            [&](std::size_t l, std::size_t r) { return box[l].lower[0] < box[r].lower[0]; });
  const auto corner = [&](std::size_t f, std::size_t k) { return vertices_[facets_[f][k]]; };
  const auto shared = [&](std::size_t f, std::size_t g) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k)
      for (std::size_t l = 0; l < static_cast<std::size_t>(dimension_); ++l)
        if (facets_[f][k] == facets_[g][l]) ++count;
    return count;
  };
  /// Neighbours that are folded onto each other.
  const auto folded = [&](std::size_t f, std::size_t g) {
    return dot(normals_[f], normals_[g]) < -1.0 + 1e-12;
  };
  const auto cross_each_other = [&](std::size_t f, std::size_t g) {
    if (dimension_ == 2) {
      if (shared(f, g) > 0) return folded(f, g);
      return segments_meet(corner(f, 0), corner(f, 1), corner(g, 0), corner(g, 1));
    }
    if (const std::size_t count = shared(f, g); count > 0) return count == 2 && folded(f, g);
    const std::array<Point, 3> a{corner(f, 0), corner(f, 1), corner(f, 2)};
    const std::array<Point, 3> b{corner(g, 0), corner(g, 1), corner(g, 2)};
    for (std::size_t k = 0; k < 3; ++k)
      if (pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a)) return true;
    return false;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t f = order[i];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const std::size_t g = order[j];
      if (box[g].lower[0] > box[f].upper[0]) break;
      if (box[g].lower[1] > box[f].upper[1] || box[f].lower[1] > box[g].upper[1] ||
          box[g].lower[2] > box[f].upper[2] || box[f].lower[2] > box[g].upper[2])
        continue;
      if (!cross_each_other(f, g)) continue;
      const std::string what = dimension_ == 2 ? "edge" : "triangle";
      refuse("a surface that crosses or touches itself, at the " + what + "s from " +
                 place_text(corner(f, 0), dimension_) + " and from " +
                 place_text(corner(g, 0), dimension_),
             dimension_ == 2 ? "edges that meet at their ends alone"
                             : "triangles that meet at their edges and corners alone");
    }
  }
}

}  // namespace surge
