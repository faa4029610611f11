#include <algorithm>

#include "compare/measure/front.hpp"

namespace surge::compare {
namespace {

/// Gathers the farthest x of points within the strip.
class Reach {
 public:
  Reach(std::size_t up, const FrontStrip& strip) : up_(up), strip_(strip) {}

  void point(const Vec3& p) {
    if (p[up_] >= strip_.lower && p[up_] <= strip_.upper) take(p[0]);
  }

  /// A piece of the contour; only its part within the strip counts.
  void segment(const Vec3& a, const Vec3& b) {
    point(a);
    point(b);
    for (const double level : {strip_.lower, strip_.upper}) {
      if ((a[up_] <= level) == (b[up_] <= level)) continue;
      const double w = (level - a[up_]) / (b[up_] - a[up_]);
      take(a[0] + w * (b[0] - a[0]));
    }
  }

  [[nodiscard]] std::optional<double> edge() const { return edge_; }

 private:
  void take(double x) { edge_ = std::max(edge_.value_or(x), x); }

  std::size_t up_;
  FrontStrip strip_;
  std::optional<double> edge_;
};

Vec3 contour_point(const Vec3& a, const Vec3& b, double alpha_a, double alpha_b) {
  const double w = (interface_level - alpha_a) / (alpha_b - alpha_a);
  return {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1]), a[2] + w * (b[2] - a[2])};
}

}  // namespace

std::optional<double> mesh_leading_edge(FrameView& view, const FrontStrip& strip, bool everything) {
  MeshTopology& mesh = view.topology();
  const std::vector<double>& alpha = view.corners().alpha;
  const MeshBodies& bodies = view.bodies(interface_level);
  const auto wet_corner = [&](MeshIndex p) { return alpha[p] >= interface_level; };
  const auto counts = [&](MeshIndex p) {
    return wet_corner(p) && (everything || bodies.body_of[p] == 0);
  };
  Reach reach(view.up(), strip);
  const double direction = view.physics().surge_direction();
  const auto along = [&](Vec3 x) {
    x[0] *= direction;
    return x;
  };
  for (MeshIndex p = 0; p < mesh.points.size(); ++p)
    if (counts(p)) reach.point(along(mesh.points[p]));
  // Going round a face, the contour runs from where the water begins to where it ends next.
  for (const std::size_t f : mesh.faces_between(strip.lower, strip.upper, view.up())) {
    const MeshIndex* corner = mesh.faces.begin(f);
    const std::size_t n = mesh.faces.length(f);
    const auto crossing = [&](std::size_t k) {
      const MeshIndex a = corner[k % n];
      const MeshIndex b = corner[(k + 1) % n];
      return contour_point(mesh.points[a], mesh.points[b], alpha[a], alpha[b]);
    };
    const auto wet = [&](std::size_t k) { return wet_corner(corner[k % n]); };
    for (std::size_t k = 0; k < n; ++k) {
      if (wet(k) || !counts(corner[(k + 1) % n])) continue;
      std::size_t end = k + 1;
      while (wet(end + 1)) ++end;
      reach.segment(along(crossing(k)), along(crossing(end)));
    }
  }
  const std::optional<double> edge = reach.edge();
  return edge ? std::optional(direction * *edge) : edge;
}

}  // namespace surge::compare
