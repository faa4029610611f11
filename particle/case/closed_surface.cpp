#include "particle/case/closed_surface.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "particle/case/vectors.hpp"

namespace surge {

namespace {

constexpr std::uint32_t facets_of_a_leaf = 4;

double square_to_box(const Box& box, const Point& x) {
  double sum = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = std::max({0.0, box.lower[a] - x[a], x[a] - box.upper[a]});
    sum += d * d;
  }
  return sum;
}

void add_to(Box& box, const Point& x) {
  for (std::size_t a = 0; a < 3; ++a) {
    box.lower[a] = std::min(box.lower[a], x[a]);
    box.upper[a] = std::max(box.upper[a], x[a]);
  }
}

Box nothing() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

/// Angle at corner k of a triangle, rad.
double angle_at(const std::array<Point, 3>& corner, std::size_t k) {
  const Point a = unit(minus(corner[(k + 1) % 3], corner[k]));
  const Point b = unit(minus(corner[(k + 2) % 3], corner[k]));
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

/// Where on a triangle the nearest place lies: 0-2 a corner, 3-5 the edge from that corner on, 6
/// the inside (Ericson 2005, Real-Time Collision Detection, 5.1.5).
std::pair<Point, int> closest_on_triangle(const Point& a, const Point& b, const Point& c,
                                          const Point& x) {
  const Point ab = minus(b, a), ac = minus(c, a);
  const Point ax = minus(x, a), bx = minus(x, b), cx = minus(x, c);
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, 0};
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0.0 && d4 <= d3) return {b, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {plus(a, d1 / (d1 - d3), ab), 3};
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0.0 && d5 <= d6) return {c, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {plus(a, d2 / (d2 - d6), ac), 5};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return {plus(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), minus(c, b)), 4};
  const double sum = va + vb + vc;
  return {plus(plus(a, vb / sum, ab), vc / sum, ac), 6};
}

}  // namespace

ClosedSurface::ClosedSurface(int dimension, std::vector<Point> vertices, std::vector<Facet> facets)
    : dimension_(dimension), vertices_(std::move(vertices)), facets_(std::move(facets)) {
  bounds_ = nothing();
  for (const Point& x : vertices_) add_to(bounds_, x);
  for (const Facet& f : facets_) {
    const Point a = vertices_[f[0]], b = vertices_[f[1]];
    if (dimension == 2) {
      normals_.push_back(unit({b[1] - a[1], a[0] - b[0], 0.0}));
      volume_ += 0.5 * cross(minus(a, bounds_.lower), minus(b, bounds_.lower))[2];
    } else {
      const Point c = vertices_[f[2]];
      const Point n = cross(minus(b, a), minus(c, a));
      normals_.push_back(unit(n));
      volume_ += dot(minus(a, bounds_.lower), n) / 6.0;
    }
  }
  build_tree();
}

Box ClosedSurface::box_of(std::size_t facet) const {
  Box box = nothing();
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k)
    add_to(box, vertices_[facets_[facet][k]]);
  return box;
}

void ClosedSurface::build_tree() {
  order_.resize(facets_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(2 * facets_.size());
  nodes_.emplace_back();
  split(0, 0, static_cast<std::uint32_t>(order_.size()));
}

/// Halves the facets by the middles of their boxes along the longest axis.
void ClosedSurface::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  Box box = nothing(), middles = nothing();
  const auto middle = [&](std::uint32_t facet, std::size_t a) {
    const Box own = box_of(facet);
    return 0.5 * (own.lower[a] + own.upper[a]);
  };
  for (std::uint32_t i = begin; i < end; ++i) {
    const Box own = box_of(order_[i]);
    add_to(box, own.lower);
    add_to(box, own.upper);
    add_to(middles, {middle(order_[i], 0), middle(order_[i], 1), middle(order_[i], 2)});
  }
  nodes_[node].box = box;
  if (end - begin <= facets_of_a_leaf) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (middles.upper[a] - middles.lower[a] > middles.upper[axis] - middles.lower[axis]) axis = a;
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t l, std::uint32_t r) {
                     const double x = middle(l, axis), y = middle(r, axis);
                     return x != y ? x < y : l < r;
                   });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = left;
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(left, begin, half);
  split(left + 1, half, end);
}

void ClosedSurface::find_pseudonormals() {
  vertex_normals_.assign(vertices_.size(), Point{});
  if (dimension_ == 2) {
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (std::size_t k = 0; k < 2; ++k)
        vertex_normals_[facets_[f][k]] = plus(vertex_normals_[facets_[f][k]], 1.0, normals_[f]);
    return;
  }
  // The two triangles of an edge meet in the order of its ends, smaller number first.
  struct Side {
    std::uint32_t low, high;
    std::size_t facet, k;
  };
  std::vector<Side> sides;
  edge_normals_.assign(facets_.size(), {});
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const Facet& facet = facets_[f];
    const std::array<Point, 3> corner{vertices_[facet[0]], vertices_[facet[1]],
                                      vertices_[facet[2]]};
    for (std::size_t k = 0; k < 3; ++k) {
      Point& normal = vertex_normals_[facet[k]];
      normal = plus(normal, angle_at(corner, k), normals_[f]);
      const std::uint32_t next = facet[(k + 1) % 3];
      sides.push_back({std::min(facet[k], next), std::max(facet[k], next), f, k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& l, const Side& r) {
    return std::pair(l.low, l.high) < std::pair(r.low, r.high);
  });
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const Point sum = plus(normals_[sides[i].facet], 1.0, normals_[sides[i + 1].facet]);
    for (const Side& side : {sides[i], sides[i + 1]}) edge_normals_[side.facet][side.k] = sum;
  }
}

Point ClosedSurface::facet_middle(std::size_t facet) const {
  Point sum{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k)
    sum = plus(sum, 1.0 / dimension_, vertices_[facets_[facet][k]]);
  return sum;
}

double ClosedSurface::facet_size(std::size_t facet) const {
  const Facet& f = facets_[facet];
  const Point side = minus(vertices_[f[1]], vertices_[f[0]]);
  if (dimension_ == 2) return std::sqrt(dot(side, side));
  const Point n = cross(side, minus(vertices_[f[2]], vertices_[f[0]]));
  return 0.5 * std::sqrt(dot(n, n));
}

double ClosedSurface::area() const {
  double sum = 0.0;
  for (std::size_t f = 0; f < facets_.size(); ++f) sum += facet_size(f);
  return sum;
}

ClosedSurface::Found ClosedSurface::closest_on(std::size_t facet, const Point& x) const {
  const Facet& f = facets_[facet];
  const Point &a = vertices_[f[0]], &b = vertices_[f[1]];
  Found found;
  found.facet = facet;
  found.pseudonormal = &normals_[facet];
  if (dimension_ == 2) {
    const Point along = minus(b, a);
    const double t = std::clamp(dot(minus(x, a), along) / dot(along, along), 0.0, 1.0);
    found.place = t == 1.0 ? b : plus(a, t, along);
    if (t == 0.0) found.pseudonormal = &vertex_normals_[f[0]];
    if (t == 1.0) found.pseudonormal = &vertex_normals_[f[1]];
  } else {
    const auto [place, part] = closest_on_triangle(a, b, vertices_[f[2]], x);
    found.place = place;
    if (part < 3) found.pseudonormal = &vertex_normals_[f[static_cast<std::size_t>(part)]];
    if (part >= 3 && part < 6)
      found.pseudonormal = &edge_normals_[facet][static_cast<std::size_t>(part - 3)];
  }
  const Point d = minus(x, found.place);
  found.square = dot(d, d);
  return found;
}

std::optional<ClosedSurface::Found> ClosedSurface::search(const Point& x,
                                                          const std::vector<bool>* only) const {
  std::optional<Found> best;
  std::array<std::pair<std::uint32_t, double>, 64> stack;  // the tree is halved: 64 levels suffice
  std::size_t depth = 0;
  stack[depth++] = {0, square_to_box(nodes_[0].box, x)};
  while (depth > 0) {
    const auto [at, least] = stack[--depth];
    if (best && least > best->square) continue;
    const Node& node = nodes_[at];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t facet = order_[i];
      if (only != nullptr && !(*only)[facet]) continue;
      const Found found = closest_on(facet, x);
      // Of facets that are as near the first one counts, whatever the tree.
      if (!best || found.square < best->square ||
          (found.square == best->square && facet < best->facet))
        best = found;
    }
    if (node.count > 0) continue;
    std::pair<std::uint32_t, double> near{node.first, square_to_box(nodes_[node.first].box, x)};
    std::pair<std::uint32_t, double> far{node.first + 1,
                                         square_to_box(nodes_[node.first + 1].box, x)};
    if (far.second < near.second) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

NearestPlace ClosedSurface::place_of(const Found& found, const Point& x, bool inside) {
  const double distance = std::sqrt(found.square);
  NearestPlace nearest{found.place, inside ? -distance : distance, {}, found.facet};
  const Point d = minus(x, found.place);
  const Point& n = *found.pseudonormal;
  // Where x is on the surface to rounding, the way to it has no direction.
  const double scale = std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]);
  nearest.normal = distance > 1e-12 * scale ? unit(inside ? minus({}, d) : d) : unit(n);
  return nearest;
}

NearestPlace ClosedSurface::nearest(const Point& x) const {
  const Found found = *search(x, nullptr);
  NearestPlace place = place_of(found, x, dot(minus(x, found.place), *found.pseudonormal) < 0.0);
  // On a facet the direction is its normal, without the rounding of a short way to it.
  if (found.pseudonormal == &normals_[found.facet]) place.normal = normals_[found.facet];
  return place;
}

std::optional<NearestPlace> ClosedSurface::nearest_of(const Point& x,
                                                      const std::vector<bool>& facets) const {
  const auto found = search(x, &facets);
  if (!found) return std::nullopt;
  NearestPlace place = place_of(*found, x, holds(x));
  if (found->pseudonormal == &normals_[found->facet]) place.normal = normals_[found->facet];
  return place;
}

bool ClosedSurface::holds(const Point& x) const {
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a)
    if (x[a] < bounds_.lower[a] || x[a] > bounds_.upper[a]) return false;
  return nearest(x).distance < 0.0;
}

/// Cuts the polygon at one side of the box after the other.
double ClosedSurface::area_in(const Box& box) const {
  std::vector<Point> corners = vertices_, left;
  for (std::size_t side = 0; side < 4; ++side) {
    const std::size_t a = side / 2;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const double at = side % 2 == 0 ? box.lower[a] : box.upper[a];
    left.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &from = corners[i], &to = corners[(i + 1) % corners.size()];
      const double d0 = sign * (from[a] - at), d1 = sign * (to[a] - at);
      if (d0 >= 0.0) left.push_back(from);
      if ((d0 >= 0.0) != (d1 >= 0.0)) left.push_back(plus(from, d0 / (d0 - d1), minus(to, from)));
    }
    corners.swap(left);
  }
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += 0.5 * cross(minus(corners[i], box.lower),
                        minus(corners[(i + 1) % corners.size()], box.lower))[2];
  return area;
}

double ClosedSurface::share_of(const Box& box, int halvings) const {
  Point middle{};
  double square = 0.0, volume = 1.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a) {
    if (box.upper[a] <= bounds_.lower[a] || box.lower[a] >= bounds_.upper[a]) return 0.0;
    middle[a] = 0.5 * (box.lower[a] + box.upper[a]);
    square += std::pow(0.5 * (box.upper[a] - box.lower[a]), 2);
    volume *= box.upper[a] - box.lower[a];
  }
  if (dimension_ == 2) return std::clamp(area_in(box) / volume, 0.0, 1.0);
  const NearestPlace nearest = this->nearest(middle);
  if (nearest.distance >= std::sqrt(square)) return 0.0;
  if (nearest.distance <= -std::sqrt(square)) return 1.0;
  if (halvings == 0) {
    // Of a box that a plane cuts: its extent along the normal, and how far the middle is behind.
    double extent = 0.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a)
      extent += std::abs(nearest.normal[a]) * (box.upper[a] - box.lower[a]);
    return std::clamp(0.5 - nearest.distance / extent, 0.0, 1.0);
  }
  double sum = 0.0;
  const int parts = 1 << dimension_;
  for (int part = 0; part < parts; ++part) {
    Box half = box;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a)
      ((part >> a & 1) != 0 ? half.lower : half.upper)[a] = middle[a];
    sum += share_of(half, halvings - 1);
  }
  return sum / parts;
}

}  // namespace surge
