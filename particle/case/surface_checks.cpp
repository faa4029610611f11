#include "particle/case/surface_checks.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "particle/case/vectors.hpp"

namespace surge {

namespace {

constexpr double opposite = -0.94;  ///< cosine of the angle between normals: 160 degrees or more
constexpr double touching = 1e-6;   ///< of a spacing
constexpr double most_samples = 1e5;

/// Signed distance to a box, m.
double distance_to_box(const Box& box, const Point& x, std::size_t axes) {
  double square = 0.0, deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < axes; ++a) {
    const double past = std::max(box.lower[a] - x[a], x[a] - box.upper[a]);
    square += std::pow(std::max(past, 0.0), 2);
    deepest = std::max(deepest, past);
  }
  return square > 0.0 ? std::sqrt(square) : deepest;
}

/// A solid of the case, obstacles first and moving walls after them.
struct Solid {
  Box box;
  const ClosedSurface* surface = nullptr;
  std::string name;

  [[nodiscard]] double distance(const Point& x, std::size_t axes) const {
    return surface != nullptr ? surface->distance(x) : distance_to_box(box, x, axes);
  }
};

class SurfaceChecker {
 public:
  SurfaceChecker(const Case& c, const TomlTable& root)
      : case_(c), root_(root), axes_(static_cast<std::size_t>(c.dimension)) {
    for (std::size_t i = 0; i < c.obstacles.size(); ++i)
      solids_.push_back(
          {c.obstacles[i], c.obstacles[i].surface.get(), "obstacle." + std::to_string(i)});
    for (std::size_t i = 0; i < c.moving_walls.size(); ++i)
      solids_.push_back({c.moving_walls[i].box, nullptr, "moving_wall." + std::to_string(i)});
  }

  void check_overlaps() const {
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i) {
      for (std::size_t k = 0; solids_[i].surface != nullptr && k < case_.blocks.size(); ++k) {
        const FluidBlock& block = case_.blocks[k];
        if (block.shape != FluidBlock::Shape::ball) {
          if (solids_[i].surface->share_of(block.box) > 1.0 - 1e-9)
            refuse(i,
                   "all of block." + std::to_string(k) +
                       (is_of_tank(i) ? " outside the room" : " inside it"),
                   "room for the fluid");
          continue;
        }
        Point centre{};
        for (std::size_t a = 0; a < axes_; ++a)
          centre[a] = 0.5 * (block.box.lower[a] + block.box.upper[a]);
        const double radius = 0.5 * (block.box.upper[0] - block.box.lower[0]);
        if (solids_[i].surface->distance(centre) < radius - 0.05 * case_.spacing)
          refuse(i, "an overlap with the ball block." + std::to_string(k),
                 "separate bodies; out of a box of fluid an obstacle cuts its place");
      }
    }
    for_each_pair([&](std::size_t i, const Solid& other) {
      if (!overlap(solids_[i], other)) return;
      refuse(i, "an overlap with " + other.name, "separate bodies");
    });
  }

  void check_thickness(double radius) const {
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i)
      if (solids_[i].surface != nullptr) check_body(i, radius);
    for_each_pair([&](std::size_t i, const Solid& other) {
      double gap = std::numeric_limits<double>::infinity();
      for (const Point& x : corners(solids_[i])) gap = std::min(gap, other.distance(x, axes_));
      for (const Point& x : corners(other)) gap = std::min(gap, solids_[i].distance(x, axes_));
      refuse_gap(i, gap, other.name);
    });
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i)
      if (solids_[i].surface != nullptr && case_.has_tank) check_walls_of_tank(i);
  }

 private:
  /// Those after the stated ones fill the tank around its room.
  [[nodiscard]] bool is_of_tank(std::size_t i) const {
    return i >= root_.tables("obstacle").size();
  }

  [[noreturn]] void refuse(std::size_t i, const std::string& found,
                           const std::string& expected) const {
    const TomlTable table = is_of_tank(i) ? root_.table("tank") : root_.tables("obstacle")[i];
    throw table.error(place_key(table), found, expected);
  }

  /// f(number of an obstacle with a surface, another solid), each pair once.
  template <class F>
  void for_each_pair(F&& f) const {
    for (std::size_t i = 0; i < case_.obstacles.size(); ++i) {
      if (solids_[i].surface == nullptr) continue;
      for (std::size_t j = 0; j < solids_.size(); ++j)
        if (j != i && (solids_[j].surface == nullptr || j > i)) f(i, solids_[j]);
    }
  }

  /// Whether a place lies deeper than the slack in both. Boxes are halved until they are as small
  /// as the slack, or too far from either to hold such a place.
  [[nodiscard]] bool overlap(const Solid& a, const Solid& b) const {
    Box shared;
    double square = 0.0;
    for (std::size_t k = 0; k < axes_; ++k) {
      shared.lower[k] = std::max(a.box.lower[k], b.box.lower[k]);
      shared.upper[k] = std::min(a.box.upper[k], b.box.upper[k]);
      if (!(shared.upper[k] > shared.lower[k])) return false;
      square += std::pow(shared.upper[k] - shared.lower[k], 2);
    }
    const double slack = std::max(0.05 * case_.spacing, 1e-3 * std::sqrt(square));
    const std::function<bool(const Box&, double)> deep = [&](const Box& box, double half) {
      Point middle{};
      for (std::size_t k = 0; k < axes_; ++k) middle[k] = 0.5 * (box.lower[k] + box.upper[k]);
      const double least = std::max(a.distance(middle, axes_), b.distance(middle, axes_));
      if (least < -slack) return true;
      if (least - half >= -slack || half < slack) return false;
      for (std::size_t part = 0; part < (std::size_t{1} << axes_); ++part) {
        Box piece = box;
        for (std::size_t k = 0; k < axes_; ++k)
          ((part >> k & 1U) != 0 ? piece.lower : piece.upper)[k] = middle[k];
        if (deep(piece, 0.5 * half)) return true;
      }
      return false;
    };
    return deep(shared, 0.5 * std::sqrt(square));
  }

  /// Places of a surface from which distances to other solids are taken.
  [[nodiscard]] std::vector<Point> corners(const Solid& solid) const {
    std::vector<Point> found;
    if (solid.surface != nullptr) {
      found = solid.surface->vertices();
      for (std::size_t f = 0; f < solid.surface->facets().size(); ++f)
        found.push_back(solid.surface->facet_middle(f));
      return found;
    }
    for (std::size_t k = 0; k < (std::size_t{1} << axes_); ++k) {
      Point x = solid.box.lower;
      for (std::size_t a = 0; a < axes_; ++a)
        if ((k >> a & 1U) != 0) x[a] = solid.box.upper[a];
      found.push_back(x);
    }
    return found;
  }

  void refuse_gap(std::size_t i, double gap, const std::string& to) const {
    if (gap <= touching * case_.spacing || gap >= case_.spacing * (1.0 - touching)) return;
    refuse(i, "a gap of " + number_text(std::round(gap * 1e9) / 1e9) + " m to " + to,
           "none, or at least a spacing of " + number_text(case_.spacing) +
               " m, into which a particle fits");
  }

  void check_walls_of_tank(std::size_t i) const {
    const Box &body = solids_[i].box, &tank = case_.tank.box;
    for (std::size_t a = 0; a < axes_; ++a) {
      if (case_.tank.periodic[a]) continue;
      if (!case_.tank.open[2 * a]) refuse_gap(i, body.lower[a] - tank.lower[a], "the tank's wall");
      if (!case_.tank.open[2 * a + 1])
        refuse_gap(i, tank.upper[a] - body.upper[a], "the tank's wall");
    }
  }

  /// Whether water can be at a place: in the tank and in no fixed solid.
  [[nodiscard]] bool is_wet(const Point& x) const {
    const Tank& tank = case_.tank;
    for (std::size_t a = 0; case_.has_tank && a < axes_; ++a)
      if (!tank.periodic[a] && (x[a] < tank.box.lower[a] || x[a] > tank.box.upper[a])) return false;
    return std::all_of(solids_.begin(),
                       solids_.begin() + static_cast<std::ptrdiff_t>(case_.obstacles.size()),
                       [&](const Solid& solid) { return solid.distance(x, axes_) > 0.0; });
  }

  /// Calls f(place) for places all over a facet, about `step` apart.
  template <class F>
  void for_each_sample(const ClosedSurface& surface, std::size_t facet, double step, F&& f) const {
    const ClosedSurface::Facet& corner = surface.facets()[facet];
    const Point& a = surface.vertices()[corner[0]];
    const Point ab = minus(surface.vertices()[corner[1]], a);
    const double size = surface.facet_size(facet);
    if (axes_ == 2) {
      const double n = std::ceil(size / step);
      for (double k = 0.0; k < n; ++k) f(plus(a, (k + 0.5) / n, ab));
      return;
    }
    const Point ac = minus(surface.vertices()[corner[2]], a);
    const double n = std::ceil(std::sqrt(2.0 * size) / step);
    for (double j = 0.0; j < n; ++j)
      for (double k = 0.0; j + k < n; ++k)
        f(plus(plus(a, (j + 1.0 / 3.0) / n, ab), (k + 1.0 / 3.0) / n, ac));
  }

  /// A ball as wide as the radius that touches the surface from inside is met by no other wet face
  /// that faces it; one a spacing wide from outside by none of the same body.
  void check_body(std::size_t i, double radius) const {
    const ClosedSurface& surface = *solids_[i].surface;
    const std::size_t facets = surface.facets().size();
    const double out = 1e-3 * case_.spacing;
    std::vector<bool> wet(facets);
    for (std::size_t f = 0; f < facets; ++f)
      wet[f] = is_wet(plus(surface.facet_middle(f), out, surface.facet_normal(f)));
    const double size = axes_ == 2 ? surface.area() : std::sqrt(surface.area());
    const double step =
        std::max(0.5 * case_.spacing, size / (axes_ == 2 ? most_samples : std::sqrt(most_samples)));
    double roomiest = 0.0;
    bool any = false;
    for (std::size_t f = 0; f < facets; ++f) {
      if (!wet[f]) continue;
      const Point& n = surface.facet_normal(f);
      for_each_sample(surface, f, step, [&](const Point& place) {
        if (!is_wet(plus(place, out, n))) return;
        any = true;
        const Point inner = plus(place, -0.5 * radius, n);
        const NearestPlace near = *surface.nearest_of(inner, wet);
        // Beyond a face that is covered the way is free, too.
        const bool through = near.distance > 0.0 && is_wet(inner);
        const double room = through ? 0.0 : std::abs(near.distance);
        roomiest = std::max(roomiest, room);
        if (room < 0.5 * radius * (1.0 - 1e-6) &&
            dot(surface.facet_normal(near.facet), n) < opposite)
          refuse_thin(i, 0.5 * radius - (through ? near.distance : -room), radius);
        const NearestPlace beyond = surface.nearest(plus(place, 0.5 * case_.spacing, n));
        if (beyond.distance < 0.5 * case_.spacing * (1.0 - 1e-6) &&
            dot(surface.facet_normal(beyond.facet), n) < opposite)
          refuse_gap(i, 0.5 * case_.spacing + beyond.distance, "itself");
      });
    }
    if (any && roomiest < 0.25 * radius) refuse_thin(i, 2.0 * roomiest, radius);
  }

  [[noreturn]] void refuse_thin(std::size_t i, double thickness, double radius) const {
    refuse(i,
           "a body " + number_text(std::round(std::max(thickness, 0.0) * 1e9) / 1e9) +
               " m thick with room for water on both sides",
           "at least " + number_text(std::round(radius * 1e9) / 1e9) +
               " m, over which particles act on each other, or a finer spacing; faces may meet at "
               "20 degrees or more");
  }

  const Case& case_;
  const TomlTable& root_;
  std::size_t axes_;
  std::vector<Solid> solids_;
};

}  // namespace

void check_surface_overlaps(const Case& c, const TomlTable& root) {
  SurfaceChecker(c, root).check_overlaps();
}

void check_surface_thickness(const Case& c, const TomlTable& root, double radius) {
  SurfaceChecker(c, root).check_thickness(radius);
}

std::string place_key(const TomlTable& obstacle) {
  for (const char* key : {"polygon", "stl", "vertices"})
    if (obstacle.has(key)) return key;
  return "lower";
}

}  // namespace surge
