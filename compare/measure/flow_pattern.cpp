#include "compare/measure/flow_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace surge::compare {
namespace {

/// Height of the grid where the tank's own is not known or far above all water, over L: water
/// higher than that is a few drops.
constexpr double grid_height = 8.0;

}  // namespace

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

FractionGrid::FractionGrid(const Physics& physics, Metres cell)
    : axes_(FrameView(physics, cell).axes()), cell_(cell.value()) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double length = physics.column_width().value();
  std::size_t cells = 1;
  for (const std::size_t a : axes_) {
    double extent = grid_height * length;
    origin_[a] = physics.tank && std::isfinite(physics.tank->lower[a]) ? physics.tank->lower[a]
                                                                       : physics.column.lower[a];
    if (a == 0 && physics.far_wall()) extent = physics.far_wall()->value();
    if (a != 0 && a != up) {
      extent = physics.column.upper[a] - physics.column.lower[a];
      if (physics.tank && std::isfinite(physics.tank->upper[a]))
        extent = physics.tank->upper[a] - origin_[a];
    }
    count_[a] =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(extent / cell_ - 1e-6)));
    cells *= count_[a];
  }
  origin_[up] = physics.floor();
  fraction_.assign(cells, 0.0);
}

void FractionGrid::add_box(const Extent& box, double fraction) {
  std::array<std::size_t, 3> first{}, last{1, 1, 1};
  for (const std::size_t a : axes_) {
    const double limit = static_cast<double>(count_[a]);
    const double from = (box.lower[a] - origin_[a]) / cell_;
    const double to = (box.upper[a] - origin_[a]) / cell_;
    first[a] = static_cast<std::size_t>(std::clamp(std::floor(from), 0.0, limit));
    last[a] = static_cast<std::size_t>(std::clamp(std::ceil(to), 0.0, limit));
  }
  std::array<std::size_t, 3> k{};
  for (k[2] = first[2]; k[2] < last[2]; ++k[2]) {
    for (k[1] = first[1]; k[1] < last[1]; ++k[1]) {
      for (k[0] = first[0]; k[0] < last[0]; ++k[0]) {
        double part = fraction;
        for (const std::size_t a : axes_) {
          const double low = origin_[a] + static_cast<double>(k[a]) * cell_;
          part *= std::max(0.0, std::min(box.upper[a], low + cell_) - std::max(box.lower[a], low)) /
                  cell_;
        }
        fraction_[(k[2] * count_[1] + k[1]) * count_[0] + k[0]] += part;
      }
    }
  }
}

void FractionGrid::add(const FrameView& frame) {
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (const double fraction = frame.fraction(i); fraction > 0.0) add_box(frame.box(i), fraction);
}

Extent FractionGrid::box_of(std::size_t cell) const {
  const std::array<std::size_t, 3> k{cell % count_[0], cell / count_[0] % count_[1],
                                     cell / (count_[0] * count_[1])};
  Extent box;
  for (const std::size_t a : axes_) {
    box.lower[a] = origin_[a] + static_cast<double>(k[a]) * cell_;
    box.upper[a] = box.lower[a] + cell_;
  }
  return box;
}

double FractionGrid::volume() const {
  return std::pow(cell_, static_cast<double>(axes_.size())) *
         std::accumulate(fraction_.begin(), fraction_.end(), 0.0);
}

std::vector<bool> FractionGrid::wet() const {
  std::vector<bool> cells(size());
  for (std::size_t i = 0; i < size(); ++i) cells[i] = wet(i);
  return cells;
}

double overlap(const FractionGrid& a, const std::vector<bool>& b) {
  std::size_t both = 0, either = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    both += a.wet(i) && b[i] ? 1 : 0;
    either += a.wet(i) || b[i] ? 1 : 0;
  }
  return either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 1.0;
}

double overlap(const FractionGrid& a, const FractionGrid& b) {
  return overlap(a, b.wet());
}

Detached detached(FrameView& frame, const Cohesion& cohesion) {
  Detached out;
  if (frame.particles() != nullptr) {
    const auto& sizes = frame.pieces(cohesion.linking_length).sizes;
    if (sizes.empty()) return out;
    out.pieces = sizes.size() - 1;
    out.part = 1.0 - static_cast<double>(sizes.front()) / static_cast<double>(frame.size());
    return out;
  }
  const std::vector<double>& volumes = frame.bodies(cohesion.corner_level).volumes;
  const std::vector<double>& water = frame.corners().volume;
  const double all = std::accumulate(water.begin(), water.end(), 0.0);
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

const std::vector<bool>& WaterOfRun::wet(std::size_t index, Metres cell) {
  const auto [found, added] = known_.try_emplace({index, cell.value()});
  if (added) {
    try {
      view_.show(run_.frames->read(index, {}));
    } catch (...) {
      known_.erase(found);
      throw;
    }
    FractionGrid grid(run_.physics, cell);
    grid.add(view_);
    found->second = grid.wet();
  }
  return found->second;
}

PatternObservable::PatternObservable(const Run& run, WaterOfRun* reference)
    : run_(run), reference_(reference) {
  if (reference_ != nullptr && reference_->run().physics.dimension != run.physics.dimension)
    reference_ = nullptr;
}

void PatternObservable::look(FrameView& frame) {
  PatternSample sample{frame.time(), {}, {}, {}};
  for (std::size_t c = 0; c < cohesion_count; ++c)
    sample.detached[c] = detached(frame, {linking_lengths[c], corner_levels[c]});
  if (const ParticleFrame* particles = frame.particles()) {
    const auto distance = smallest_distance(particles->position);
    if (distance) sample.smallest_distance = *distance / run_.spacing.value();
  }
  const auto other = reference_ != nullptr
                         ? frame_at(reference_->run().frames->times(), sample.time)
                         : std::nullopt;
  if (other) {
    const Metres cell = overlap_cell(run_, reference_->run());
    FractionGrid mine(reference_->run().physics, cell);
    mine.add(frame);
    sample.overlap = overlap(mine, reference_->wet(*other, cell));
  }
  history_.push_back(sample);
}

}  // namespace surge::compare
