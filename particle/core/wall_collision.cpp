#include "particle/core/wall_collision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surge {
namespace {

/// How far behind a face one looks for what lies there, as a share of the body's size.
constexpr double behind = 1e-6;

}  // namespace

template <int D>
WallCollision<D>::WallCollision(const Case& c, double distance, double restitution)
    : has_tank_(c.has_tank),
      tank_(c.tank),
      surfaces_(surface_walls<D>(c, distance)),
      surface_tip_(1e-3 * c.spacing),
      distance_(distance),
      restitution_(restitution) {
  const auto grow = [distance](Box& box) {
    for (int a = 0; a < D; ++a) {
      box.lower[a] -= distance;
      box.upper[a] += distance;
    }
  };
  for (const Obstacle& obstacle : c.obstacles)
    if (!obstacle.surface) solid_.push_back(obstacle);
  expanded_ = solid_;
  for (Box& box : expanded_) grow(box);
  for (const MovingWall& wall : c.moving_walls) {
    movers_.push_back({wall, wall.box, {}, {}, {}});
    grow(movers_.back().expanded);
  }
  move_walls(0.0, 0.0);
}

template <int D>
void WallCollision<D>::move_walls(double begin, double end) {
  for (Mover& mover : movers_) {
    const MotionState before = motion_at(mover.wall.law, begin);
    const MotionState after = motion_at(mover.wall.law, end);
    for (std::size_t a = 0; a < D; ++a) {
      mover.before[a] = before.displacement * mover.wall.direction[a];
      mover.after[a] = after.displacement * mover.wall.direction[a];
      mover.velocity[a] = after.velocity * mover.wall.direction[a];
    }
  }
}

template <int D>
bool WallCollision<D>::apply(const Vec<D>& start, Vec<D>& end, Vec<D>& velocity) const {
  bool met = false;
  // What glances off one obstacle can meet the next; more than a few in one step do not happen.
  for (int pass = 0; pass < 4; ++pass) {
    bool again = false;
    for (const Box& box : expanded_) again = keep_out(box, start, end, velocity) || again;
    for (const SurfaceWall<D>& wall : surfaces_)
      again = wall.keep_out(start, restitution_, end, velocity) || again;
    for (const Mover& mover : movers_) again = keep_out_of(mover, start, end, velocity) || again;
    again = keep_in_tank(end, velocity) || again;
    if (!again) break;
    met = true;
  }
  return met;
}

template <int D>
bool WallCollision<D>::keep_in_tank(Vec<D>& end, Vec<D>& velocity) const {
  if (!has_tank_) return false;
  bool met = false;
  for (int a = 0; a < D; ++a) {
    if (tank_.periodic[a]) continue;
    const std::size_t side = 2 * static_cast<std::size_t>(a);
    const double lower = tank_.box.lower[a] + distance_;
    const double upper = tank_.box.upper[a] - distance_;
    // The tank is convex, so a path from inside has crossed a wall just when its end lies beyond.
    if (!tank_.open[side] && end[a] < lower) {
      end[a] = std::min(lower + restitution_ * (lower - end[a]), upper);
      velocity[a] = velocity[a] < 0.0 ? -restitution_ * velocity[a] : velocity[a];
      met = true;
    } else if (!tank_.open[side + 1] && end[a] > upper) {
      end[a] = std::max(upper - restitution_ * (end[a] - upper), lower);
      velocity[a] = velocity[a] > 0.0 ? -restitution_ * velocity[a] : velocity[a];
      met = true;
    }
  }
  return met;
}

template <int D>
bool WallCollision<D>::keep_out(const Box& box, const Vec<D>& start, Vec<D>& end,
                                Vec<D>& velocity) const {
  // Slab test: the part [enter, leave] of the path, in units of its length, that lies in the box.
  double enter = -std::numeric_limits<double>::max();
  double leave = std::numeric_limits<double>::max();
  int face_axis = -1;
  double face_sign = 0.0;
  for (int a = 0; a < D; ++a) {
    const double path = end[a] - start[a];
    if (path == 0.0) {
      if (start[a] <= box.lower[a] || start[a] >= box.upper[a]) return false;
      continue;
    }
    const double to_lower = (box.lower[a] - start[a]) / path;
    const double to_upper = (box.upper[a] - start[a]) / path;
    const double near = std::min(to_lower, to_upper);
    if (near > enter) {
      enter = near;
      face_axis = a;
      face_sign = path > 0.0 ? -1.0 : 1.0;
    }
    leave = std::min(leave, std::max(to_lower, to_upper));
  }
  if (enter >= leave || leave <= 0.0 || enter >= 1.0) return false;
  if (enter < 0.0) {
    // The path starts inside: out through the nearest face of its end.
    if (leave < 1.0) return false;
    double least = std::numeric_limits<double>::max();
    for (int a = 0; a < D; ++a) {
      if (end[a] - box.lower[a] < least)
        least = end[a] - box.lower[a], face_axis = a, face_sign = -1.0;
      if (box.upper[a] - end[a] < least)
        least = box.upper[a] - end[a], face_axis = a, face_sign = 1.0;
    }
  }
  if (face_axis < 0) return false;
  const double face = face_sign < 0.0 ? box.lower[face_axis] : box.upper[face_axis];
  const double beyond = (face - end[face_axis]) * face_sign;
  if (beyond <= 0.0) return false;
  end[face_axis] = face + face_sign * restitution_ * beyond;
  if (velocity[face_axis] * face_sign < 0.0) velocity[face_axis] *= -restitution_;
  return true;
}

/// In the frame of the wall, in which it is at rest.
template <int D>
bool WallCollision<D>::keep_out_of(const Mover& mover, const Vec<D>& start, Vec<D>& end,
                                   Vec<D>& velocity) const {
  Vec<D> from;
  Vec<D> to;
  Vec<D> v;
  for (int a = 0; a < D; ++a) {
    from[a] = start[a] - mover.before[a];
    to[a] = end[a] - mover.after[a];
    v[a] = velocity[a] - mover.velocity[a];
  }
  if (!keep_out(mover.expanded, from, to, v)) return false;
  for (int a = 0; a < D; ++a) {
    end[a] = to[a] + mover.after[a];
    velocity[a] = v[a] + mover.velocity[a];
  }
  return true;
}

template <int D>
bool WallCollision<D>::is_lost(const Vec<D>& x) const {
  for (int a = 0; has_tank_ && a < D; ++a)
    if (!tank_.periodic[a] && (x[a] < tank_.box.lower[a] || x[a] > tank_.box.upper[a])) return true;
  return in_obstacle(x);
}

template <int D>
bool WallCollision<D>::is_solid(const Vec<D>& x) const {
  for (int a = 0; has_tank_ && a < D; ++a) {
    if (tank_.periodic[a]) continue;
    const std::size_t side = 2 * static_cast<std::size_t>(a);
    if (x[a] < tank_.box.lower[a] && !tank_.open[side]) return true;
    if (x[a] > tank_.box.upper[a] && !tank_.open[side + 1]) return true;
  }
  return in_obstacle(x);
}

template <int D>
bool WallCollision<D>::in_obstacle(const Vec<D>& x) const {
  const auto inside = [](const Box& box, const Vec<D>& point) {
    for (int a = 0; a < D; ++a)
      if (point[a] <= box.lower[a] || point[a] >= box.upper[a]) return false;
    return true;
  };
  if (std::any_of(solid_.begin(), solid_.end(), [&](const Box& box) { return inside(box, x); }))
    return true;
  if (std::any_of(surfaces_.begin(), surfaces_.end(),
                  [&](const SurfaceWall<D>& wall) { return wall.holds(x); }))
    return true;
  return std::any_of(movers_.begin(), movers_.end(), [&](const Mover& mover) {
    Vec<D> point = x;
    for (int a = 0; a < D; ++a) point[a] -= mover.after[a];
    return inside(mover.wall.box, point);
  });
}

template <int D>
template <class F>
std::optional<Vec<D>> WallCollision<D>::first_of_boxes(F&& f) const {
  for (const Box& box : solid_)
    if (const auto found = f(box)) return found;
  for (const Mover& mover : movers_) {
    Box box = mover.wall.box;
    for (int a = 0; a < D; ++a) {
      box.lower[a] += mover.after[a];
      box.upper[a] += mover.after[a];
    }
    if (const auto found = f(box)) return found;
  }
  return std::nullopt;
}

template <int D>
std::optional<Vec<D>> WallCollision<D>::free_face(const Box& box, const Vec<D>& x) const {
  double least = std::numeric_limits<double>::max();
  std::optional<Vec<D>> nearest;
  for (int a = 0; a < D; ++a) {
    const double tip = behind * (box.upper[a] - box.lower[a]);
    for (const double side : {-1.0, 1.0}) {
      Vec<D> point = x;
      point[a] = side < 0.0 ? box.lower[a] : box.upper[a];
      const double distance = std::abs(point[a] - x[a]);
      Vec<D> outside = point;
      outside[a] += side * tip;
      // What reaches a periodic side goes on behind it.
      const bool cut = has_tank_ && tank_.periodic[a] &&
                       (outside[a] < tank_.box.lower[a] || outside[a] > tank_.box.upper[a]);
      if (distance >= least || cut || is_solid(outside)) continue;
      least = distance;
      nearest = point;
    }
  }
  return nearest;
}

template <int D>
std::optional<Vec<D>> WallCollision<D>::free_surface_of_wall(const Vec<D>& x) const {
  Vec<D> point = x;
  Vec<D> inside = x;
  for (int a = 0; has_tank_ && a < D; ++a) {
    if (tank_.periodic[a]) continue;
    point[a] = std::clamp(x[a], tank_.box.lower[a], tank_.box.upper[a]);
    inside[a] = point[a];
    const double tip = behind * (tank_.box.upper[a] - tank_.box.lower[a]);
    if (x[a] != point[a]) inside[a] += x[a] < point[a] ? tip : -tip;
  }
  const auto leave = [&](const Box& box) -> std::optional<Vec<D>> {
    for (int a = 0; a < D; ++a)
      if (inside[a] < box.lower[a] || inside[a] > box.upper[a]) return std::nullopt;
    return free_face(box, point);
  };
  const auto from_box = first_of_boxes(leave);
  if (from_box) return from_box;
  for (const SurfaceWall<D>& wall : surfaces_) {
    if (!wall.holds(inside)) continue;
    const auto place = wall.free_place(point);
    if (!place) return std::nullopt;
    Vec<D> found, outside;
    const Point& n = wall.surface().facet_normal(place->facet);
    for (int a = 0; a < D; ++a) {
      found[a] = place->place[a];
      outside[a] = found[a] + surface_tip_ * n[a];
    }
    return is_solid(outside) ? std::nullopt : std::optional<Vec<D>>(found);
  }
  return is_solid(inside) ? std::nullopt : std::optional<Vec<D>>(point);
}

template class WallCollision<2>;
template class WallCollision<3>;

}  // namespace surge
