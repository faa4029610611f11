#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "particle/case/case.hpp"
#include "particle/core/particles.hpp"

namespace surge {

/// Whether a place in front of an obstacle's surface lies in a wall of the tank (open sides
/// included) or in another obstacle.
[[nodiscard]] bool is_covered(const Case& c, std::size_t number, const Point& x);

/// An obstacle with a surface as a wall for particles. Its free facets are those that no wall of
/// the tank and no other fixed solid covers, by their middles.
template <int D>
class SurfaceWall {
 public:
  /// `number`: of the obstacle in the case; `distance`: m, of the wall in front of the surface
  SurfaceWall(const Case& c, std::size_t number, double distance);

  /// Corrects the end of a path and the velocity as WallCollision::apply() does. Along the path,
  /// steps as long as the way to the wall, and no shorter than a part of the path, find where it
  /// comes behind the wall; the end is then put before the plane that is the wall there.
  bool keep_out(const Vec<D>& start, double restitution, Vec<D>& end, Vec<D>& velocity) const;
  [[nodiscard]] bool holds(const Vec<D>& x) const;
  /// The free place that is nearest; none where all is covered.
  [[nodiscard]] std::optional<NearestPlace> free_place(const Vec<D>& x) const;
  [[nodiscard]] const ClosedSurface& surface() const { return *surface_; }
  /// Which facets are free.
  [[nodiscard]] const std::vector<bool>& free() const { return free_; }

 private:
  std::shared_ptr<const ClosedSurface> surface_;
  std::vector<bool> free_;
  double distance_;
  double least_step_;  ///< m, along a path
};

template <int D>
[[nodiscard]] Point point_of(const Vec<D>& x) {
  Point p{};
  for (std::size_t a = 0; a < D; ++a) p[a] = x[a];
  return p;
}

/// The obstacles of a case that have a surface.
template <int D>
[[nodiscard]] std::vector<SurfaceWall<D>> surface_walls(const Case& c, double distance);

}  // namespace surge
