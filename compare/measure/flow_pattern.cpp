#include "compare/measure/flow_pattern.hpp"

#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "compare/read/pieces.hpp"

namespace surge::compare {
namespace {

/// Height of the grid where the tank's own is not known or far above all water, over L: water
/// higher than that is a few drops.
constexpr double grid_height = 8.0;

/// The reference's frame at a time; empty where there is none within a tenth of its interval.
std::optional<std::size_t> frame_at(const std::vector<Seconds>& times, Seconds time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  std::optional<std::size_t> best;
  double distance = std::numeric_limits<double>::infinity();
  for (auto it = after == times.begin() ? after : after - 1; it != times.end() && it <= after;
       ++it) {
    const double d = std::abs((*it - time).value());
    if (d < distance) {
      distance = d;
      best = static_cast<std::size_t>(it - times.begin());
    }
  }
  const double interval = times.size() > 1 ? (times.back() - times.front()).value() /
                                                 static_cast<double>(times.size() - 1)
                                           : 0.0;
  return best && distance <= 0.1 * interval + 1e-9 ? best : std::nullopt;
}

}  // namespace

FractionGrid::FractionGrid(const Physics& physics, Metres cell)
    : left_(physics.tank ? physics.tank->lower[0] : physics.column.lower[0]),
      floor_(physics.floor()),
      cell_(cell.value()),
      up_(static_cast<std::size_t>(physics.vertical_axis())) {
  const double length = physics.column_width().value();
  const double wall = physics.far_wall() ? physics.far_wall()->value() : 8.0 * length;
  columns_ = static_cast<std::size_t>(std::ceil(wall / cell_ - 1e-6));
  rows_ = static_cast<std::size_t>(std::ceil(grid_height * length / cell_ - 1e-6));
  fraction_.assign(columns_ * rows_, 0.0);
}

void FractionGrid::add_box(double x0, double x1, double y0, double y1, double fraction) {
  const auto cells = [&](double from, double to, std::size_t count) {
    const double limit = static_cast<double>(count);
    return std::pair{static_cast<std::size_t>(std::clamp(std::floor(from / cell_), 0.0, limit)),
                     static_cast<std::size_t>(std::clamp(std::ceil(to / cell_), 0.0, limit))};
  };
  const auto [i0, i1] = cells(x0, x1, columns_);
  const auto [j0, j1] = cells(y0, y1, rows_);
  const auto covered = [&](std::size_t k, double from, double to) {
    const double low = static_cast<double>(k) * cell_;
    return std::max(0.0, std::min(to, low + cell_) - std::max(from, low));
  };
  for (std::size_t j = j0; j < j1; ++j) {
    for (std::size_t i = i0; i < i1; ++i) {
      fraction_[j * columns_ + i] +=
          fraction * covered(i, x0, x1) * covered(j, y0, y1) / (cell_ * cell_);
    }
  }
}

void FractionGrid::add(const Frame& frame, const Run& run) {
  if (const auto* particles = std::get_if<ParticleFrame>(&frame)) {
    const double half = 0.5 * run.spacing.value();
    for (const Vec3& r : particles->position) {
      const double x = r[0] - left_, y = r[up_] - floor_;
      add_box(x - half, x + half, y - half, y + half, 1.0);
    }
    return;
  }
  const auto& mesh = std::get<MeshFrame>(frame);
  for (std::size_t c = 0; c < mesh.alpha.size(); ++c) {
    if (mesh.alpha[c] <= 0.0) continue;
    std::array<double, 6> b{};
    mesh.grid->GetCellBounds(static_cast<vtkIdType>(c), b.data());
    add_box(b[0] - left_, b[1] - left_, b[2 * up_] - floor_, b[2 * up_ + 1] - floor_,
            mesh.alpha[c]);
  }
}

double FractionGrid::area() const {
  return cell_ * cell_ * std::accumulate(fraction_.begin(), fraction_.end(), 0.0);
}

double overlap(const FractionGrid& a, const FractionGrid& b) {
  std::size_t both = 0, either = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    both += a.wet(i) && b.wet(i) ? 1 : 0;
    either += a.wet(i) || b.wet(i) ? 1 : 0;
  }
  return either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 1.0;
}

Detached detached(const ParticleFrame& frame, Metres spacing, double linking_length) {
  const auto sizes = connected_pieces(frame.position, linking_length * spacing.value()).sizes;
  Detached out;
  if (sizes.empty()) return out;
  out.pieces = sizes.size() - 1;
  out.part = 1.0 - static_cast<double>(sizes.front()) / static_cast<double>(frame.position.size());
  return out;
}

Detached detached(MeshFront& mesh, const MeshFrame& frame, double level) {
  const auto [volumes, all] = mesh.pieces(frame, level);
  Detached out;
  if (volumes.empty() || all <= 0.0) return out;
  const double inside = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  out.pieces = volumes.size() - 1;
  out.part = (inside - volumes.front()) / all;
  out.blurred = 1.0 - inside / all;
  return out;
}

std::optional<double> smallest_distance(const std::vector<Vec3>& position) {
  if (position.size() < 2) return std::nullopt;
  std::vector<Vec3> sorted = position;
  std::sort(sorted.begin(), sorted.end());
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j][0] - sorted[i][0] < best; ++j) {
      best = std::min(best, std::hypot(sorted[j][0] - sorted[i][0], sorted[j][1] - sorted[i][1],
                                       sorted[j][2] - sorted[i][2]));
    }
  }
  return best;
}

Metres overlap_cell(const Run& a, const Run& b) {
  const double length = b.physics.column_width().value();
  const double coarser = std::max(a.spacing.value(), b.spacing.value());
  return Metres(length / std::max(1.0, std::floor(length / coarser + 1e-6)));
}

PatternHistory measure_pattern(const Run& run, const Run& reference) {
  const bool plane = run.physics.dimension == 2 && reference.physics.dimension == 2;
  const Metres cell = overlap_cell(run, reference);
  MeshFront mesh;
  PatternHistory history;
  for (std::size_t k = 0; k < run.frames->times().size(); ++k) {
    const Frame frame = run.frames->read(k, {});
    PatternSample sample{time_of(frame), {}, {}, {}};
    const auto* particles = std::get_if<ParticleFrame>(&frame);
    for (std::size_t c = 0; c < cohesion_count; ++c) {
      sample.detached[c] = particles ? detached(*particles, run.spacing, linking_lengths[c])
                                     : detached(mesh, std::get<MeshFrame>(frame), corner_levels[c]);
    }
    if (particles) {
      const auto distance = smallest_distance(particles->position);
      if (distance) sample.smallest_distance = *distance / run.spacing.value();
    }
    const auto other = frame_at(reference.frames->times(), sample.time);
    if (plane && other && &run != &reference) {
      FractionGrid mine(reference.physics, cell), theirs(reference.physics, cell);
      mine.add(frame, run);
      theirs.add(reference.frames->read(*other, {}), reference);
      sample.overlap = overlap(mine, theirs);
    }
    history.push_back(sample);
  }
  return history;
}

}  // namespace surge::compare
