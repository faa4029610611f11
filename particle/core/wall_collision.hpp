#pragma once

#include <optional>

#include "particle/case/case.hpp"
#include "particle/core/particles.hpp"
#include "particle/core/surface_walls.hpp"

namespace surge {

/// Keeps particles on the fluid's side of the walls, looking at the whole path of a step and not
/// only at its end, so that none passes a wall however fast it is or however thin the obstacle.
/// A wall here is the plane `distance` in front of the solid surface.
template <int D>
class WallCollision {
 public:
  /// distance: m; restitution: ratio of normal speeds after and before, 0 to 1
  WallCollision(const Case& c, double distance, double restitution);

  /// Walls that move go from where they are at `begin` to where they are at `end` (s) in the paths
  /// that follow.
  void move_walls(double begin, double end);

  /// Corrects the end of the straight path from `start` to `end` and the velocity. Returns whether
  /// the path met a wall; a particle that a moving wall meets has no less than the wall's velocity
  /// afterwards. `start` need not be free of walls: a particle inside one is pushed out.
  bool apply(const Vec<D>& start, Vec<D>& end, Vec<D>& velocity) const;

  /// Whether x lies outside the tank (open sides included) or inside an obstacle or moving wall.
  [[nodiscard]] bool is_lost(const Vec<D>& x) const;
  /// Whether x lies beyond a wall of the tank or inside an obstacle or moving wall.
  [[nodiscard]] bool is_solid(const Vec<D>& x) const;
  /// The point nearest to x, in a wall, on the surface of that wall; where another wall covers it,
  /// as a piston covers the floor, on what of that one's surface is free. Empty where none is.
  [[nodiscard]] std::optional<Vec<D>> free_surface_of_wall(const Vec<D>& x) const;

 private:
  struct Mover {
    MovingWall wall;
    Box expanded;  ///< its box at displacement zero, grown by the distance
    Vec<D> before{};
    Vec<D> after{};
    Vec<D> velocity{};
  };
  bool keep_out_of(const Mover& mover, const Vec<D>& start, Vec<D>& end, Vec<D>& velocity) const;
  [[nodiscard]] bool in_obstacle(const Vec<D>& x) const;
  /// The nearest point of a box's faces behind which nothing is solid. x: in the box or on it.
  [[nodiscard]] std::optional<Vec<D>> free_face(const Box& box, const Vec<D>& x) const;
  /// f(box) for all obstacles and moving walls where they are, until it gives a point.
  template <class F>
  [[nodiscard]] std::optional<Vec<D>> first_of_boxes(F&& f) const;
  bool keep_in_tank(Vec<D>& end, Vec<D>& velocity) const;
  bool keep_out(const Box& obstacle, const Vec<D>& start, Vec<D>& end, Vec<D>& velocity) const;

  bool has_tank_;
  Tank tank_;
  std::vector<Box> solid_;     ///< boxes of obstacles as they are
  std::vector<Box> expanded_;  ///< the same grown by the distance
  std::vector<SurfaceWall<D>> surfaces_;
  std::vector<Mover> movers_;
  double surface_tip_;  ///< m, before a surface: where one looks for what covers it
  double distance_;
  double restitution_;
};

}  // namespace surge
