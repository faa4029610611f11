#include "compare/figures/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace surge::compare {

namespace {

constexpr double level = 0.5;

/// Weights of the corners at floor(s - 1/2) .. + 2 for a particle at s, in spacings.
struct Spline {
  long first;
  std::array<double, 3> weight;
};
Spline spline_at(double s) {
  const double middle = std::floor(s + 0.5);
  const double d = s - middle;  // -1/2 .. 1/2
  return {static_cast<long>(middle) - 1,
          {0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)}};
}

/// The covered part on corners a spacing apart.
class Cover {
 public:
  explicit Cover(double spacing) : spacing_(spacing) {}

  void add(double x, double y) {
    const Spline a = spline_at(x / spacing_), b = spline_at(y / spacing_);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        part_[key(a.first + long(i), b.first + long(j))] += a.weight[i] * b.weight[j];
  }
  [[nodiscard]] double at(long i, long j) const {
    const auto found = part_.find(key(i, j));
    return found == part_.end() ? 0.0 : found->second;
  }
  /// Lower left corners of all boxes that have a covered corner, in a fixed order.
  [[nodiscard]] std::vector<std::pair<long, long>> boxes() const {
    std::vector<std::pair<long, long>> found;
    for (const auto& [k, part] : part_) {
      const auto [i, j] = place(k);
      for (const long di : {-1L, 0L})
        for (const long dj : {-1L, 0L}) found.emplace_back(i + di, j + dj);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  static std::uint64_t key(long i, long j) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32U |
           static_cast<std::uint32_t>(j);
  }
  static std::pair<long, long> place(std::uint64_t k) {
    return {static_cast<std::int32_t>(k >> 32U), static_cast<std::int32_t>(k & 0xffffffffU)};
  }

  double spacing_;
  std::unordered_map<std::uint64_t, double> part_;
};

/// A particle once more behind each wall that is near.
void add_mirrored(Cover& cover, const WaterPatch& p, const Solids& solids, double spacing) {
  std::array<double, 2> xs{p.x, p.x}, ys{p.y, p.y};
  std::size_t nx = 1, ny = 1;
  const auto near = [&](double a, double wall) {
    return std::isfinite(wall) && std::abs(a - wall) < 1.5 * spacing;
  };
  if (solids.tank) {
    const Rectangle& tank = *solids.tank;
    const auto has = [&](const std::string& side) { return !solids.open.contains(side); };
    const std::string up(1, solids.up_side.at(0));
    if (has("x-") && near(p.x, tank.x0)) xs[nx++] = 2.0 * tank.x0 - p.x;
    if (nx == 1 && has("x+") && near(p.x, tank.x1)) xs[nx++] = 2.0 * tank.x1 - p.x;
    if (has(up + "-") && near(p.y, tank.y0)) ys[ny++] = 2.0 * tank.y0 - p.y;
    if (ny == 1 && has(up + "+") && near(p.y, tank.y1)) ys[ny++] = 2.0 * tank.y1 - p.y;
  }
  for (std::size_t i = 0; i < nx; ++i)
    for (std::size_t j = 0; j < ny; ++j) cover.add(xs[i], ys[j]);
}

bool is_within(const Rectangle& box, double x, double y, double margin) {
  return x > box.x0 - margin && x < box.x1 + margin && y > box.y0 - margin && y < box.y1 + margin;
}

/// Whether there can be a free surface: inside the tank, and not along a solid.
bool is_free(const Solids& solids, Seconds time, double x, double y, double spacing) {
  if (solids.tank && !is_within(*solids.tank, x, y, 1e-9)) return false;
  for (const Rectangle& box : solids.obstacles)
    if (is_within(box, x, y, spacing)) return false;
  for (const Outline& outline : solids.outlines)
    if (is_near(outline, x, y, spacing)) return false;
  for (const Solids::MovingWall& wall : solids.walls)
    if (is_within(wall.at(time), x, y, spacing)) return false;
  return true;
}

}  // namespace

void add_level(const Rectangle& box, const std::array<double, 4>& above,
               std::vector<Segment>& lines) {
  const std::array<double, 4> x{box.x0, box.x1, box.x1, box.x0};
  const std::array<double, 4> y{box.y0, box.y0, box.y1, box.y1};
  std::array<std::pair<double, double>, 4> crossings;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    if ((above[i] >= 0.0) == (above[j] >= 0.0)) continue;
    const double s = above[i] / (above[i] - above[j]);
    crossings[count++] = {x[i] + s * (x[j] - x[i]), y[i] + s * (y[j] - y[i])};
  }
  for (std::size_t i = 0; i + 1 < count; i += 2)
    lines.push_back(
        {crossings[i].first, crossings[i].second, crossings[i + 1].first, crossings[i + 1].second});
}

std::vector<Segment> free_surface(const WaterPicture& picture, const Solids& solids, Seconds time) {
  if (picture.mesh || picture.patches.empty()) return picture.surface;
  const double spacing = 2.0 * picture.patches.front().half_x;
  Cover cover(spacing);
  for (const WaterPatch& patch : picture.patches) add_mirrored(cover, patch, solids, spacing);
  std::vector<Segment> lines, free;
  for (const auto& [i, j] : cover.boxes()) {
    const Rectangle box{double(i) * spacing, double(j) * spacing, double(i + 1) * spacing,
                        double(j + 1) * spacing};
    add_level(box,
              {cover.at(i, j) - level, cover.at(i + 1, j) - level, cover.at(i + 1, j + 1) - level,
               cover.at(i, j + 1) - level},
              lines);
  }
  for (const Segment& s : lines)
    if (is_free(solids, time, 0.5 * (s.x0 + s.x1), 0.5 * (s.y0 + s.y1), spacing)) free.push_back(s);
  return free;
}

}  // namespace surge::compare
