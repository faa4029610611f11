#include <algorithm>
#include <cmath>

#include "compare/read/physics.hpp"

namespace surge::compare {
namespace {

/// A part of the floor: along x and across.
struct Patch {
  std::array<double, 2> lower{}, upper{};

  [[nodiscard]] bool holds(const std::array<double, 2>& x) const {
    return x[0] >= lower[0] && x[0] <= upper[0] && x[1] >= lower[1] && x[1] <= upper[1];
  }
};

Patch patch_of(const Extent& box, std::size_t across, bool plane) {
  Patch patch{{box.lower[0], box.lower[across]}, {box.upper[0], box.upper[across]}};
  // In 2D the third coordinate means nothing.
  if (plane) patch.lower[1] = 0.0, patch.upper[1] = 1.0;
  return patch;
}

/// Whether the patches leave nothing of `all`: looked at between all of their edges.
bool cover(const std::vector<Patch>& patches, const Patch& all) {
  std::array<std::vector<double>, 2> edges;
  for (std::size_t a = 0; a < 2; ++a) {
    edges[a] = {all.lower[a], all.upper[a]};
    for (const Patch& patch : patches) {
      for (const double x : {patch.lower[a], patch.upper[a]})
        if (x > all.lower[a] && x < all.upper[a]) edges[a].push_back(x);
    }
    std::sort(edges[a].begin(), edges[a].end());
  }
  // What rounding leaves between two boxes is no gap.
  const double least = 1e-6 * (all.upper[0] - all.lower[0] + all.upper[1] - all.lower[1]);
  for (std::size_t i = 1; i < edges[0].size(); ++i) {
    for (std::size_t j = 1; j < edges[1].size(); ++j) {
      if (edges[0][i] - edges[0][i - 1] < least || edges[1][j] - edges[1][j - 1] < least) continue;
      const std::array<double, 2> middle{0.5 * (edges[0][i] + edges[0][i - 1]),
                                         0.5 * (edges[1][j] + edges[1][j - 1])};
      const auto holds = [&](const Patch& patch) { return patch.holds(middle); };
      if (std::none_of(patches.begin(), patches.end(), holds)) return false;
    }
  }
  return true;
}

bool is_finite(const Extent& box, std::size_t axis) {
  return std::isfinite(box.lower[axis]) && std::isfinite(box.upper[axis]);
}

bool spans(const Extent& box, const std::optional<Extent>& tank) {
  if (!tank || !is_finite(*tank, 0)) return false;
  const double slack = 1e-6 * (tank->upper[0] - tank->lower[0]);
  return box.lower[0] <= tank->lower[0] + slack && box.upper[0] >= tank->upper[0] - slack;
}

/// Depth of the blocks besides number `column` where they cover the floor beyond it; zero else.
double bed_beyond(const Physics& physics, std::size_t column) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const std::size_t across = 3 - up;
  const bool plane = physics.dimension == 2;
  const std::vector<WaterBody>& blocks = *physics.blocks;
  const std::optional<Extent>& tank = physics.tank;
  if (!tank || !is_finite(*tank, 0) || (!plane && !is_finite(*tank, across))) return 0.0;
  Physics seen = physics;  // with this column, which decides what lies beyond
  seen.column = blocks[column].box;
  Patch open = patch_of(*tank, across, plane);
  if (seen.surge_direction() > 0.0) {
    open.lower[0] = seen.column.upper[0];
  } else {
    open.upper[0] = seen.column.lower[0];
  }
  if (!(open.upper[0] > open.lower[0])) return 0.0;
  const double slack = 1e-3 * seen.column_width().value();
  std::vector<Patch> patches;
  std::optional<double> depth;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Extent& box = blocks[i].box;
    if (i == column || blocks[i].shape != "box") continue;
    if (box.lower[up] > physics.floor() + slack) continue;
    const double top = box.upper[up] - physics.floor();
    if (depth && std::abs(top - *depth) > slack) return 0.0;
    depth = top;
    patches.push_back(patch_of(box, across, plane));
  }
  if (!depth) return 0.0;
  for (const SolidBody& box : physics.obstacles.value_or(std::vector<SolidBody>{}))
    patches.push_back(patch_of(box, across, plane));
  return cover(patches, open) ? *depth : 0.0;
}

}  // namespace

std::size_t column_among_blocks(const Physics& physics) {
  const std::vector<WaterBody>& blocks = *physics.blocks;
  if (blocks.size() == 1) return 0;
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  std::optional<std::size_t> first, highest;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (spans(blocks[i].box, physics.tank)) continue;
    if (!first) first = i;
    if (!highest || blocks[i].box.upper[up] > blocks[*highest].box.upper[up]) highest = i;
  }
  if (highest && bed_beyond(physics, *highest) > 0.0) return *highest;
  return first.value_or(0);
}

std::optional<Metres> Physics::bed_depth() const {
  if (stated_bed) return stated_bed;
  if (!blocks) return std::nullopt;
  if (blocks->size() < 2) return Metres(0.0);
  return Metres(bed_beyond(*this, column_among_blocks(*this)));
}

}  // namespace surge::compare
