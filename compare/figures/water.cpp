#include "compare/figures/water.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "compare/figures/surface.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

namespace {

/// Cells with less water than this are not drawn: they would only tint the air.
constexpr double visible_fraction = 0.01;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// From metres and pascals to the units of the picture.
struct WaterView : PictureScale {
  double pressure_scale, speed_scale;

  explicit WaterView(const Run& run) : PictureScale(run) {
    const double height = run.physics.column.upper[up] - run.physics.column.lower[up];
    // A source that does not state its density is water.
    pressure_scale =
        run.physics.density.value_or(1000.0) * run.physics.gravity_magnitude() * height;
    speed_scale = std::sqrt(2.0 * run.physics.gravity_magnitude() * height);
  }
  [[nodiscard]] double speed(const Vec3& u) const {
    return std::hypot(u[0], u[1], u[2]) / speed_scale;
  }
};

WaterPicture particle_picture(const ParticleFrame& frame, const Run& run, bool whole) {
  const WaterView view(run);
  const double half = 0.5 * run.spacing.value();
  const bool has_velocity = frame.velocity.size() == frame.position.size();
  const bool has_pressure = frame.pressure.size() == frame.position.size();
  WaterPicture picture;
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    const Vec3& r = frame.position[i];
    if (view.three_dimensional && !whole && std::abs(r[view.depth] - view.middle) > half) continue;
    picture.patches.push_back({view.x(r[0]), view.y(r[view.up]), half / view.length,
                               half / view.length,
                               has_pressure ? frame.pressure[i] / view.pressure_scale : unknown,
                               1.0, has_velocity ? view.speed(frame.velocity[i]) : unknown});
    if (whole) {
      picture.patches.back().z = view.z(r[view.depth]);
      picture.patches.back().half_z = half / view.length;
    }
  }
  return picture;
}

/// Values at the corners of boxes: means over the boxes that share the corner.
class CornerMeans {
 public:
  void add(double x, double y, double value) {
    auto& [sum, count] = sums_[key(x, y)];
    sum += value;
    ++count;
  }
  [[nodiscard]] double at(double x, double y) const {
    const auto& [sum, count] = sums_.at(key(x, y));
    return sum / count;
  }

 private:
  /// Corners closer than 1e-6 L are one: processors of a decomposed case hold their own copies.
  static std::pair<long, long> key(double x, double y) {
    return {std::lround(1e6 * x), std::lround(1e6 * y)};
  }
  std::map<std::pair<long, long>, std::pair<double, int>> sums_;
};

/// The line alpha = 0.5 in one box, linear along its edges (marching squares).
void add_surface(const WaterPatch& box, const CornerMeans& corners, std::vector<Segment>& surface) {
  const Rectangle edges{box.x - box.half_x, box.y - box.half_y, box.x + box.half_x,
                        box.y + box.half_y};
  add_level(edges,
            {corners.at(edges.x0, edges.y0) - 0.5, corners.at(edges.x1, edges.y0) - 0.5,
             corners.at(edges.x1, edges.y1) - 0.5, corners.at(edges.x0, edges.y1) - 0.5},
            surface);
}

WaterPicture mesh_picture(const MeshFrame& frame, const Run& run, bool whole) {
  vtkDataArray* pressure = frame.grid->GetCellData()->GetArray("p");
  // A case of OpenFOAM starts from p_rgh: it has no p before the first step.
  const bool is_start = run.frames != nullptr && frame.time <= run.frames->times().front();
  if (pressure == nullptr && !is_start) {
    throw Error(run.path.string() + ": no cell array p, expected one to colour the figure");
  }
  vtkDataArray* velocity = frame.grid->GetCellData()->GetArray("U");
  const WaterView view(run);
  WaterPicture picture;
  picture.mesh = true;
  std::vector<WaterPatch> boxes;
  CornerMeans corners;
  for (vtkIdType cell = 0; cell < frame.grid->GetNumberOfCells(); ++cell) {
    std::array<double, 6> b{};
    frame.grid->GetCellBounds(cell, b.data());
    const auto low = [&](std::size_t axis) { return b[2 * axis]; };
    const auto high = [&](std::size_t axis) { return b[2 * axis + 1]; };
    if (view.three_dimensional && !whole &&
        (view.middle < low(view.depth) || view.middle >= high(view.depth))) {
      continue;
    }
    WaterPatch box{
        view.x(0.5 * (low(0) + high(0))),
        view.y(0.5 * (low(view.up) + high(view.up))),
        0.5 * (high(0) - low(0)) / view.length,
        0.5 * (high(view.up) - low(view.up)) / view.length,
        pressure != nullptr ? pressure->GetComponent(cell, 0) / view.pressure_scale : unknown,
        frame.alpha[static_cast<std::size_t>(cell)]};
    if (velocity != nullptr) {
      Vec3 u;
      velocity->GetTuple(cell, u.data());
      box.speed = view.speed(u);
    }
    if (whole) {
      box.z = view.z(0.5 * (low(view.depth) + high(view.depth)));
      box.half_z = 0.5 * (high(view.depth) - low(view.depth)) / view.length;
      if (box.fraction >= visible_fraction) picture.patches.push_back(box);
      continue;
    }
    for (double sx : {-1.0, 1.0}) {
      for (double sy : {-1.0, 1.0}) {
        corners.add(box.x + sx * box.half_x, box.y + sy * box.half_y, box.fraction);
      }
    }
    boxes.push_back(box);
  }
  for (const auto& box : boxes) {
    add_surface(box, corners, picture.surface);
    if (box.fraction >= visible_fraction) picture.patches.push_back(box);
  }
  return picture;
}

double volume(const WaterPatch& patch) {
  return patch.fraction * patch.half_x * patch.half_y;
}

}  // namespace

double WaterPicture::part_above(double height) const {
  double above = 0.0, all = 0.0;
  for (const auto& patch : patches) {
    all += volume(patch);
    if (patch.y > height) above += volume(patch);
  }
  return all > 0.0 ? above / all : 0.0;
}

double WaterPicture::height_of(double part) const {
  auto sorted = patches;
  std::sort(sorted.begin(), sorted.end(),
            [](const WaterPatch& a, const WaterPatch& b) { return a.y < b.y; });
  const double all = std::accumulate(sorted.begin(), sorted.end(), 0.0,
                                     [](double sum, const auto& p) { return sum + volume(p); });
  double below = 0.0;
  for (const auto& patch : sorted) {
    below += volume(patch);
    if (below >= part * all) return patch.y + patch.half_y;
  }
  return sorted.empty() ? 0.0 : sorted.back().y + sorted.back().half_y;
}

void WaterPicture::paint(Image& image) const {
  for (const auto& patch : patches) {
    const Colour colour = std::isnan(patch.pressure) ? unknown_colour : viridis(patch.pressure);
    if (mesh) {
      image.rectangle(patch.x - patch.half_x, patch.x + patch.half_x, patch.y - patch.half_y,
                      patch.y + patch.half_y, colour, std::clamp(patch.fraction, 0.0, 1.0));
    } else {
      image.disc(patch.x, patch.y, patch.half_x, colour);
    }
  }
}

WaterPicture water_picture(const Frame& frame, const Run& run) {
  if (const auto* particles = std::get_if<ParticleFrame>(&frame))
    return particle_picture(*particles, run, false);
  return mesh_picture(std::get<MeshFrame>(frame), run, false);
}

std::vector<WaterPatch> water_in_space(const Frame& frame, const Run& run) {
  if (const auto* particles = std::get_if<ParticleFrame>(&frame))
    return particle_picture(*particles, run, true).patches;
  return mesh_picture(std::get<MeshFrame>(frame), run, true).patches;
}

}  // namespace surge::compare
