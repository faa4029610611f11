#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "particle/case/box.hpp"

namespace surge {

/// The place on a surface that is nearest to a point x.
struct NearestPlace {
  Point place{};          ///< m
  double distance = 0.0;  ///< from x, m; negative where x is inside
  Point normal{};         ///< unit vector out of the body: the gradient of the distance at x
  std::size_t facet = 0;
};

/// The surface of a solid body: in 2D a polygon, whose facets are its edges, in 3D triangles. It is
/// closed, does not cross itself, and its facets face outwards.
///
/// The distance is exact. Its sign is that of (x - q) n, where q is the nearest place and n its
/// pseudonormal: of a facet its own, of an edge or a corner the sum of those around, in 3D weighted
/// by the angles that they make there (Baerentzen & Aanaes 2005, IEEE Trans. Vis. Comput. Graph.
/// 11). Facets are searched in a tree of boxes: a search takes the logarithm of their number.
class ClosedSurface {
 public:
  using Facet = std::array<std::uint32_t, 3>;  ///< numbers of its corners; in 2D the first two
  static constexpr std::size_t most_corners = 5000;  ///< of a polygon
  static constexpr std::size_t most_triangles = 20000;

  /// A polygon by its corners, in either sense, the last one joined to the first. Throws Error
  /// ("found ..., expected ...") where it is no simple polygon.
  [[nodiscard]] static ClosedSurface polygon(std::vector<Point> corners);
  /// Throws Error where the triangles do not make up a closed surface that faces outwards.
  [[nodiscard]] static ClosedSurface triangles(std::vector<Point> vertices,
                                               std::vector<Facet> facets);

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] const std::vector<Point>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }
  [[nodiscard]] const Point& facet_normal(std::size_t facet) const { return normals_[facet]; }
  /// Middle of the corners of a facet, m.
  [[nodiscard]] Point facet_middle(std::size_t facet) const;
  /// Length of an edge (2D, m), area of a triangle (3D, m2).
  [[nodiscard]] double facet_size(std::size_t facet) const;
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  [[nodiscard]] double volume() const { return volume_; }  ///< m3, in 2D m2
  [[nodiscard]] double area() const;                       ///< of the surface: m2, in 2D m

  [[nodiscard]] NearestPlace nearest(const Point& x) const;
  /// The same among some facets alone; nothing where there are none. The sign of the distance is
  /// still that of the whole surface.
  [[nodiscard]] std::optional<NearestPlace> nearest_of(const Point& x,
                                                       const std::vector<bool>& facets) const;
  /// Negative inside, m.
  [[nodiscard]] double distance(const Point& x) const { return nearest(x).distance; }
  [[nodiscard]] bool holds(const Point& x) const;

  /// The part of a box that is inside, 0 to 1. In 2D exact: the area of the polygon that is left
  /// between the sides of the box (Sutherland & Hodgman 1974, Commun. ACM 17). In 3D the box is
  /// halved along its axes where the surface passes, so often, and what is left counts by the
  /// distance of its middle: with four halvings to about 1e-3.
  [[nodiscard]] double share_of(const Box& box, int halvings = 4) const;

 private:
  struct Node {
    Box box;
    std::uint32_t first = 0;  ///< of a leaf its facets in order_, else the left child; the right
    std::uint32_t count = 0;  ///< one follows. Number of facets of a leaf, else 0
  };
  ClosedSurface(int dimension, std::vector<Point> vertices, std::vector<Facet> facets);
  void build_tree();
  void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  void find_pseudonormals();
  void require_simple() const;
  [[nodiscard]] Box box_of(std::size_t facet) const;
  [[nodiscard]] double area_in(const Box& box) const;
  struct Found {
    Point place;
    double square = 0.0;  ///< of the distance, m2
    const Point* pseudonormal = nullptr;
    std::size_t facet = 0;
  };
  [[nodiscard]] Found closest_on(std::size_t facet, const Point& x) const;
  [[nodiscard]] std::optional<Found> search(const Point& x, const std::vector<bool>* only) const;
  [[nodiscard]] static NearestPlace place_of(const Found& found, const Point& x, bool inside);

  int dimension_;
  std::vector<Point> vertices_;
  std::vector<Facet> facets_;
  std::vector<Point> normals_;                      ///< of facets, unit
  std::vector<Point> vertex_normals_;               ///< pseudonormals, of any length
  std::vector<std::array<Point, 3>> edge_normals_;  ///< of the edges of triangles from corner k on
  Box bounds_;
  double volume_ = 0.0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace surge
