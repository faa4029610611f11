#include "particle/case/solid_cells.hpp"

#include <algorithm>
#include <cmath>

namespace surge {

namespace {

/// Faces closer than this share of a spacing are one.
constexpr double same_face = 1e-6;

/// A solid box by its number among obstacles and moving walls after those. What has a surface has
/// checks of its own (surface_checks.hpp).
struct NumberedBox : Box {
  std::size_t number = 0;
};

std::vector<NumberedBox> solids_of(const Case& c) {
  std::vector<NumberedBox> solids;
  for (std::size_t i = 0; i < c.obstacles.size(); ++i)
    if (!c.obstacles[i].surface) solids.push_back({c.obstacles[i], i});
  for (std::size_t i = 0; i < c.moving_walls.size(); ++i)
    solids.push_back({c.moving_walls[i].box, c.obstacles.size() + i});
  return solids;
}

/// The coordinates of all faces along an axis, in order, without those that are the same. Without a
/// tank there is space all around.
std::vector<double> edges_of(const Case& c, const std::vector<NumberedBox>& solids,
                             std::size_t axis) {
  if (axis >= static_cast<std::size_t>(c.dimension)) return {0.0, 1.0};
  std::vector<double> edges;
  const auto add = [&](const Box& box) {
    edges.push_back(box.lower[axis]);
    edges.push_back(box.upper[axis]);
  };
  for (const Box& box : solids) add(box);
  if (c.has_tank) {
    add(c.tank.box);
  } else {
    for (const FluidBlock& block : c.blocks) add(block.box);
    const auto [low, high] = std::minmax_element(edges.begin(), edges.end());
    const double margin = 1e6 * c.spacing + (*high - *low);
    const Box around{{*low - margin, *low - margin, *low - margin},
                     {*high + margin, *high + margin, *high + margin}};
    add(around);
  }
  std::sort(edges.begin(), edges.end());
  const auto same = [&](double a, double b) { return b - a <= same_face * c.spacing; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

}  // namespace

double SolidCells::cell_count(const Case& c) {
  const std::vector<NumberedBox> solids = solids_of(c);
  double count = 1.0;
  for (std::size_t a = 0; a < 3; ++a)
    count *= static_cast<double>(edges_of(c, solids, a).size() - 1);
  return count;
}

SolidCells::SolidCells(const Case& c) : dimension_(static_cast<std::size_t>(c.dimension)) {
  const std::vector<NumberedBox> solids = solids_of(c);
  open_.fill(!c.has_tank);
  if (c.has_tank) open_ = c.tank.open;
  for (std::size_t a = 0; a < 3; ++a) {
    edges_[a] = edges_of(c, solids, a);
    periodic_[a] = a < dimension_ && c.has_tank && c.tank.periodic[a];
    count_[a] = edges_[a].size() - 1;
  }
  solid_.assign(count_[0] * count_[1] * count_[2], open);
  // Where bodies overlap, the first one stays.
  for (std::size_t s = solids.size(); s-- > 0;)
    for_each_inside(solids[s], [&](std::size_t i) { solid_[i] = solids[s].number; });
  mark_wet(c);
}

template <class F>
void SolidCells::for_each_inside(const Box& box, F&& f) const {
  Cell from{0, 0, 0}, to{1, 1, 1};
  for (std::size_t a = 0; a < dimension_; ++a) {
    const std::vector<double>& edges = edges_[a];
    const auto middle_below = [&](std::size_t k, double x) {
      return 0.5 * (edges[k] + edges[k + 1]) < x;
    };
    from[a] = 0;
    while (from[a] < count_[a] && middle_below(from[a], box.lower[a])) ++from[a];
    to[a] = from[a];
    while (to[a] < count_[a] && middle_below(to[a], box.upper[a])) ++to[a];
  }
  for (Cell at = from; at[2] < to[2]; ++at[2])
    for (at[1] = from[1]; at[1] < to[1]; ++at[1])
      for (at[0] = from[0]; at[0] < to[0]; ++at[0]) f(index(at));
}

std::optional<std::size_t> SolidCells::next(std::size_t at, std::size_t axis, bool up) const {
  Cell to = cell(at);
  const std::size_t last = count_[axis] - 1;
  if (to[axis] == (up ? last : 0)) {
    if (!periodic_[axis]) return std::nullopt;
    to[axis] = up ? 0 : last;
  } else {
    to[axis] = up ? to[axis] + 1 : to[axis] - 1;
  }
  return index(to);
}

/// Fills all space that is joined to the fluid; a wall that moves may let it through.
void SolidCells::mark_wet(const Case& c) {
  wet_.assign(solid_.size(), false);
  std::vector<std::size_t> front;
  const auto wet = [&](std::size_t i) {
    if (wet_[i] || (is_wall(i) && solid_[i] < c.obstacles.size())) return;
    wet_[i] = true;
    front.push_back(i);
  };
  // Faces of fluid cut no cells: one that holds any of it is wet.
  for (const FluidBlock& block : c.blocks) {
    Box reach = block.box;
    for (std::size_t a = 0; a < dimension_; ++a) {
      for (std::size_t k = 0; k < count_[a]; ++k) {
        const double lower = edges_[a][k], upper = edges_[a][k + 1];
        const bool holds = upper - block.box.lower[a] > same_face * c.spacing &&
                           block.box.upper[a] - lower > same_face * c.spacing;
        if (holds) {
          reach.lower[a] = std::min(reach.lower[a], lower);
          reach.upper[a] = std::max(reach.upper[a], upper);
        }
      }
    }
    for_each_inside(reach, wet);
  }
  while (!front.empty()) {
    const std::size_t at = front.back();
    front.pop_back();
    for (std::size_t a = 0; a < dimension_; ++a)
      for (const bool up : {false, true})
        if (const auto neighbour = next(at, a, up)) wet(*neighbour);
  }
}

/// The first stretch along an axis of cells that are `inside`, between cells that are not, whose
/// lower and upper neighbours (none: a wall of the tank) satisfy `ends`, thinner than `least`.
template <class Inside, class Ends>
std::optional<ThinPlace> SolidCells::thin_stretch(double least, bool gap, Inside&& inside,
                                                  Ends&& ends) const {
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    for (std::size_t i = 0; i < solid_.size(); ++i) {
      if (!inside(i)) continue;
      const auto before = next(i, axis, false);
      if (before && inside(*before)) continue;  // not the first of its stretch
      double thickness = 0.0;
      std::optional<std::size_t> at = i;
      for (; at && inside(*at) && thickness < least; at = next(*at, axis, true))
        thickness += width(axis, cell(*at)[axis]);
      if (thickness >= least || !ends(axis, before, at)) continue;
      const std::size_t of = gap ? (before ? solid_[*before] : open) : solid_[i];
      return ThinPlace{axis, thickness, gap,
                       of == open ? std::nullopt : std::optional<std::size_t>(of)};
    }
  }
  return std::nullopt;
}

std::optional<ThinPlace> SolidCells::thin_wall(double radius) const {
  const auto has_water = [&](const std::optional<std::size_t>& at) { return at && wet_[*at]; };
  return thin_stretch(
      radius * (1.0 - 1e-9), false, [&](std::size_t i) { return is_wall(i); },
      [&](std::size_t, const auto& below, const auto& above) {
        return has_water(below) && has_water(above);
      });
}

std::optional<ThinPlace> SolidCells::narrow_gap(double width) const {
  return thin_stretch(
      width * (1.0 - 1e-6), true, [&](std::size_t i) { return !is_wall(i); },
      [&](std::size_t axis, const auto& below, const auto& above) {
        return (below || !open_[2 * axis]) && (above || !open_[2 * axis + 1]);
      });
}

}  // namespace surge
