#include "compare/measure/open_space.hpp"

#include <array>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>

namespace surge::compare {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();

bool has_lid(const FrameView& view) {
  const auto& open = view.physics().open;
  return open && !open->contains(view.up() == 1 ? "y+" : "z+");
}

/// What is known of the tank; infinite where it is not.
Extent known_tank(const FrameView& view) {
  Extent tank;
  tank.lower.fill(-far_away);
  tank.upper.fill(far_away);
  if (view.physics().tank) {
    for (const std::size_t a : view.axes()) {
      const Extent& known = *view.physics().tank;
      if (std::isfinite(known.lower[a])) tank.lower[a] = known.lower[a];
      if (std::isfinite(known.upper[a])) tank.upper[a] = known.upper[a];
    }
  }
  tank.lower[view.up()] = view.physics().floor();
  return tank;
}

bool holds(const Extent& box, const Vec3& place, const std::vector<std::size_t>& axes) {
  return std::all_of(axes.begin(), axes.end(), [&](std::size_t a) {
    return !std::isfinite(place[a]) || (place[a] >= box.lower[a] && place[a] <= box.upper[a]);
  });
}

Extent water_extent(const FrameView& view) {
  Extent water;
  water.lower.fill(far_away);
  water.upper.fill(-far_away);
  for (std::size_t i = 0; i < view.size(); ++i) {
    const Extent box = view.box(i);
    for (const std::size_t a : view.axes()) {
      water.lower[a] = std::min(water.lower[a], box.lower[a]);
      water.upper[a] = std::max(water.upper[a], box.upper[a]);
    }
  }
  return water;
}

}  // namespace

double shared_volume(const Extent& a, const Extent& b, const std::vector<std::size_t>& axes) {
  double volume = 1.0;
  for (const std::size_t k : axes)
    volume *= std::max(0.0, std::min(a.upper[k], b.upper[k]) - std::max(a.lower[k], b.lower[k]));
  return volume;
}

void for_each_open(FrameView& view, double top,
                   const std::function<void(const Extent& box, double part)>& action) {
  if (view.mesh() != nullptr) {
    for (std::size_t c = 0; c < view.size(); ++c) action(view.topology().box[c], view.cell_part(c));
    return;
  }
  Extent tank = known_tank(view);
  if (!has_lid(view) || !std::isfinite(tank.upper[view.up()])) tank.upper[view.up()] = top;
  const Extent water = water_extent(view);
  for (const std::size_t a : view.axes()) {
    if (!std::isfinite(tank.lower[a])) tank.lower[a] = water.lower[a];
    if (!std::isfinite(tank.upper[a])) tank.upper[a] = water.upper[a];
  }
  action(tank, 1.0);
  for (SolidBody solid : view.physics().obstacles.value_or(std::vector<SolidBody>{})) {
    if (solid.surface) continue;
    for (const std::size_t a : view.axes()) {
      solid.lower[a] = std::max(solid.lower[a], tank.lower[a]);
      solid.upper[a] = std::min(solid.upper[a], tank.upper[a]);
    }
    if (shared_volume(solid, tank, view.axes()) > 0.0) action(solid, -1.0);
  }
  for (const auto& [box, share] : view.surface_boxes()) action(box, -share);
}

bool is_inside(FrameView& view, const Vec3& place) {
  if (view.mesh() == nullptr) return holds(known_tank(view), place, view.axes());
  const std::vector<Extent>& boxes = view.topology().box;
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const Extent& box) { return holds(box, place, view.axes()); });
}

Vec3 resolution_at(FrameView& view, const Vec3& place) {
  const double spacing = view.spacing();
  if (view.mesh() == nullptr) return {spacing, spacing, spacing};
  std::array<std::vector<double>, 3> extents;
  for (const Extent& box : view.topology().box) {
    if (!holds(box, place, view.axes())) continue;
    for (const std::size_t a : view.axes()) extents[a].push_back(box.upper[a] - box.lower[a]);
  }
  Vec3 middle{};
  for (const std::size_t a : view.axes())
    middle[a] = extents[a].empty() ? spacing : boost::math::statistics::median(extents[a]);
  return middle;
}

}  // namespace surge::compare
