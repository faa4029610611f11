#include "particle/case/tank_shape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "particle/case/vectors.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge {

namespace {

/// Of the box's size: what is as near to a side is on it.
constexpr double same_place = 1e-9;

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw Error("found " + found + ", expected " + expected);
}

/// Where the room leaves the box's sides to its bodies: the body before it ends at a corner of the
/// room, the next one begins at another (or the same) one, and both reach the box at `place`s.
struct RoomContact {
  std::size_t end = 0, begin = 0;  ///< numbers of the room's corners
  Point end_place{}, begin_place{};
};

class PlaneTank {
 public:
  PlaneTank(const ClosedSurface& room, const Box& box)
      : corners_(room.vertices()), box_(box), slack_(same_place * (width(0) + width(1))) {
    for (Point& x : corners_)  // to the last digit, so that no sliver is left
      for (std::size_t a = 0; a < 2; ++a) {
        if (std::abs(x[a] - box.lower[a]) <= slack_) x[a] = box.lower[a];
        if (std::abs(x[a] - box.upper[a]) <= slack_) x[a] = box.upper[a];
      }
  }

  [[nodiscard]] std::vector<ClosedSurface> bodies() const {
    std::size_t joined = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) joined += is_joined(i) ? 1 : 0;
    if (joined == corners_.size()) return {};  // the room is the box
    std::vector<RoomContact> contacts = touching();
    if (contacts.size() < 2 && !(contacts.size() == 1 && contacts[0].end != contacts[0].begin))
      contacts = cuts();
    std::vector<ClosedSurface> made;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      std::vector<Point> outline = body(contacts[k], contacts[(k + 1) % contacts.size()]);
      if (outline.size() > 2) made.push_back(ClosedSurface::polygon(std::move(outline)));
    }
    return made;
  }

 private:
  [[nodiscard]] double width(std::size_t a) const { return box_.upper[a] - box_.lower[a]; }
  [[nodiscard]] std::size_t next(std::size_t i) const { return (i + 1) % corners_.size(); }

  /// Way along the sides from the lower left corner, against the clock, m; none inside.
  [[nodiscard]] std::optional<double> along(const Point& x) const {
    if (x[1] == box_.lower[1]) return x[0] - box_.lower[0];
    if (x[0] == box_.upper[0]) return width(0) + (x[1] - box_.lower[1]);
    if (x[1] == box_.upper[1]) return width(0) + width(1) + (box_.upper[0] - x[0]);
    if (x[0] == box_.lower[0]) return 2.0 * width(0) + width(1) + (box_.upper[1] - x[1]);
    return std::nullopt;
  }
  /// Whether a corner and the next one lie on one side.
  [[nodiscard]] bool is_joined(std::size_t i) const {
    const Point &a = corners_[i], &b = corners_[next(i)];
    for (std::size_t k = 0; k < 2; ++k)
      for (const double side : {box_.lower[k], box_.upper[k]})
        if (a[k] == side && b[k] == side) return true;
    return false;
  }

  /// Runs of the room's corners along the box, in their order.
  [[nodiscard]] std::vector<RoomContact> touching() const {
    const std::size_t n = corners_.size();
    std::vector<RoomContact> found;
    std::size_t first = 0;
    while (first < n && (!along(corners_[first]) || is_joined((first + n - 1) % n))) ++first;
    if (first == n) return found;
    for (std::size_t gone = 0; gone < n; ++gone) {
      std::size_t i = (first + gone) % n;
      if (!along(corners_[i])) continue;
      RoomContact run{i, i, corners_[i], corners_[i]};
      for (; is_joined(i) && gone < n; ++gone) i = next(i);
      run.begin = i;
      run.begin_place = corners_[i];
      found.push_back(run);
    }
    return found;
  }

  /// Lines from the room to the left and to the right side.
  [[nodiscard]] std::vector<RoomContact> cuts() const {
    const auto [left, right] =
        std::minmax_element(corners_.begin(), corners_.end(),
                            [](const Point& a, const Point& b) { return a[0] < b[0]; });
    const auto cut = [&](const Point& x, double side) {
      const auto i = static_cast<std::size_t>(&x - corners_.data());
      const Point place{side, x[1], 0.0};
      return RoomContact{i, i, place, place};
    };
    return {cut(*left, box_.lower[0]), cut(*right, box_.upper[0])};
  }

  /// The outline of the body between two contacts, against the clock: back along the room, and
  /// forth along the box.
  [[nodiscard]] std::vector<Point> body(const RoomContact& from, const RoomContact& to) const {
    std::vector<Point> outline;
    const auto add = [&](const Point& x) {
      if (outline.empty() || outline.back() != x) outline.push_back(x);
    };
    std::vector<Point> room;
    std::size_t i = from.begin;
    for (room.push_back(corners_[i]); i != to.end; room.push_back(corners_[i])) i = next(i);
    for (std::size_t k = room.size(); k-- > 0;) add(room[k]);
    add(from.begin_place);
    const double all = 2.0 * (width(0) + width(1));
    const double start = along(from.begin_place).value();
    double end = along(to.end_place).value();
    if (end <= start) end += all;
    const std::array<double, 4> ways{0.0, width(0), width(0) + width(1), 2.0 * width(0) + width(1)};
    const std::array<Point, 4> places{box_.lower, Point{box_.upper[0], box_.lower[1], 0.0},
                                      Point{box_.upper[0], box_.upper[1], 0.0},
                                      Point{box_.lower[0], box_.upper[1], 0.0}};
    for (const double round : {0.0, all})
      for (std::size_t k = 0; k < 4; ++k)
        if (ways[k] + round > start && ways[k] + round < end) add(places[k]);
    add(to.end_place);
    if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
    return outline;
  }

  std::vector<Point> corners_;  ///< of the room, against the clock
  Box box_;
  double slack_;  ///< m
};

/// The box's surface and the room's, turned inside out.
ClosedSurface hollow_box(const ClosedSurface& room, const Box& box) {
  std::vector<Point> vertices = room.vertices();
  std::vector<ClosedSurface::Facet> facets;
  for (const ClosedSurface::Facet& f : room.facets()) facets.push_back({f[0], f[2], f[1]});
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::size_t k = 0; k < 8; ++k) {
    Point x{};
    for (std::size_t a = 0; a < 3; ++a) x[a] = ((k >> a & 1U) != 0 ? box.upper : box.lower)[a];
    vertices.push_back(x);
  }
  // Two triangles of each side, against the clock as seen from outside; bit a of a corner's number
  // says whether it is the upper one along axis a.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& s : sides) {
    facets.push_back({first + s[0], first + s[1], first + s[2]});
    facets.push_back({first + s[0], first + s[2], first + s[3]});
  }
  return ClosedSurface::triangles(std::move(vertices), std::move(facets));
}

}  // namespace

std::vector<ClosedSurface> bodies_around(const ClosedSurface& room, const Box& box) {
  const auto axes = static_cast<std::size_t>(room.dimension());
  const Box& bounds = room.bounds();
  for (std::size_t a = 0; a < axes; ++a) {
    const double slack = same_place * (box.upper[a] - box.lower[a]);
    const double least = axes == 2 ? -slack : slack;
    const bool in =
        bounds.lower[a] - box.lower[a] >= least && box.upper[a] - bounds.upper[a] >= least;
    if (in) continue;
    const std::string axis(1, "xyz"[a]);
    refuse("a room from " + axis + " = " + number_text(bounds.lower[a]) + " to " +
               number_text(bounds.upper[a]),
           std::string(axes == 2 ? "one in" : "one that touches no side of") + " the tank's box, " +
               number_text(box.lower[a]) + " to " + number_text(box.upper[a]));
  }
  if (axes == 2) return PlaneTank(room, box).bodies();
  std::vector<ClosedSurface> made;
  made.push_back(hollow_box(room, box));
  return made;
}

}  // namespace surge
