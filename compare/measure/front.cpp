#include "compare/measure/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "compare/read/pieces.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {
namespace {

/// Part of the way from a to b, 0 where they coincide.
double part(double value, double a, double b) {
  return b == a ? 0.0 : (value - a) / (b - a);
}

/// Z is the distance of the front from the wall that the column stands at: the first frame must
/// show just that column, or the number means something else.
void check_start(const Run& run, const FrontSample& first) {
  const Physics& physics = run.physics;
  const double slack = 2.0 * run.spacing.value();
  const auto place = [](double x) { return number_text(std::round(x * 1e6) / 1e6) + " m"; };
  if (std::abs(first.time.value()) > 1e-9) return;
  const double edge = first.position.value();
  const double width = physics.column_width().value();
  if (std::abs(edge - width) <= slack) return;
  throw Error(run.path.string() + ": first frame: the leading edge is " + place(edge) +
              " from the column's wall, the column " + place(width) +
              " wide; expected the edge of the column (water lying in the tank, or a second body "
              "of water? Then the leading edge is not what to measure)");
}

/// Water that falls from the height H is at most about 2 sqrt(g H) fast, and a column that has
/// collapsed for long has moved: a time step or a unit that is typed wrong shows here.
void check_speed(const Run& run, const FrontHistory& history) {
  // What states itself in a manifest has its units and times from there.
  if (!run.manifest.is_null() || history.size() < 2) return;
  const Physics& physics = run.physics;
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double height = physics.column.upper[up] - physics.column.lower[up];
  const double scale = std::sqrt(2.0 * physics.gravity_magnitude() * height);
  double fastest = 0.0;
  for (const FrontSample& sample : history) {
    const double time = (sample.time - history.front().time).value();
    const double path = (sample.position - history.front().position).value();
    // What a front jumps by when pieces join does not count as speed.
    if (time > 0.0) fastest = std::max(fastest, (path - 4.0 * run.spacing.value()) / time);
  }
  if (fastest > 3.0 * scale) {
    throw Error(run.path.string() + ": the leading edge moves at up to " + number_text(fastest) +
                " m/s, three times sqrt(2 g H) = " + number_text(scale) +
                " m/s are expected at most (--time-step; lengths in millimetres?)");
  }
  const double moved = (history.back().position - history.front().position).value();
  const double time = (history.back().time - history.front().time).value();
  const bool long_enough = time * scale > 10.0 * height;
  const bool at_wall =
      physics.far_wall() &&
      history.back().position.value() > physics.far_wall()->value() - 4.0 * run.spacing.value();
  if (long_enough && !at_wall && moved > run.spacing.value() && moved / time < 0.03 * scale) {
    throw Error(run.path.string() + ": the leading edge needs " + number_text(time) + " s for " +
                number_text(moved) + " m, a collapse with sqrt(2 g H) = " + number_text(scale) +
                " m/s is faster (--time-step)");
  }
}

/// By how far (m) the particle at the leading edge is ahead of the next one in the strip.
double lead_of(const ParticleFrame& frame, const Physics& physics, double edge, Metres spacing,
               const FrontOptions& options) {
  const double direction = physics.surge_direction();
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double top = physics.floor() + options.strip_height.value() * (1.0 + 1e-9);
  const double foremost = direction * edge - 0.5 * spacing.value();
  double next = -std::numeric_limits<double>::infinity();
  std::size_t there = 0;
  for (const Vec3& x : frame.position) {
    const double along = direction * x[0];
    if (x[up] > top || along > foremost + 1e-9 * spacing.value()) continue;
    if (along >= foremost - 1e-9 * spacing.value() && ++there == 1) continue;
    next = std::max(next, along);
  }
  return foremost - next;
}

/// Where one particle makes the leading edge, its lead is part of the edge's uncertainty.
class Leads {
 public:
  void add(double lead, Metres spacing) {
    if (!(lead > 0.2 * spacing.value())) return;
    ++count_;
    most_ = std::max(most_, lead);
  }
  void tell(Run& run, std::size_t frames) const {
    if (count_ == 0) return;
    run.notices.push_back("in " + std::to_string(count_) + " of " + std::to_string(frames) +
                          " frames one particle makes the leading edge, up to " +
                          number_text(std::round(most_ * 1e6) / 1e6) + " m ahead of the next");
  }

 private:
  std::size_t count_ = 0;
  double most_ = 0.0;
};

std::string short_text(double value) {
  return number_text(std::round(value * 1e6) / 1e6);
}

/// A surge goes forward until it meets a wall, by about as much from frame to frame. Where it goes
/// back or jumps, water has left or joined the main body, or files of a foreign source are out of
/// order or of two runs.
void tell_course(Run& run, const FrontHistory& history) {
  if (!run.manifest.is_null() || run.is_mesh()) return;
  const double l0 = run.spacing.value();
  const double wall = run.physics.far_wall() ? run.physics.far_wall()->value() - 4.0 * l0
                                             : std::numeric_limits<double>::infinity();
  const auto step = [&](std::size_t i) {
    return i == 0 || i >= history.size() ? 0.0
                                         : (history[i].position - history[i - 1].position).value();
  };
  std::size_t back = 0, jumps = 0;
  std::string first_back, first_jump;
  double farthest = history.front().position.value();
  for (std::size_t i = 1; i < history.size() && farthest < wall; ++i) {
    const std::string place = " m at " + short_text(history[i].time.value()) + " s";
    const double here = history[i].position.value();
    if (here < farthest - 0.2 * l0 && back++ == 0)
      first_back = short_text(farthest) + " m to " + short_text(here) + place;
    if (step(i) > 2.0 * l0 && step(i) > 2.5 * std::max(step(i - 1), step(i + 1)) && jumps++ == 0)
      first_jump = short_text(step(i)) + place;
    farthest = std::max(farthest, here);
  }
  const std::string reason = " (water that leaves or joins the main body, or files out of order)";
  if (back > 0)
    run.notices.push_back("the leading edge goes back in " + std::to_string(back) +
                          " frames, first from " + first_back + reason);
  if (jumps > 0 && history.size() > 2)
    run.notices.push_back("the leading edge jumps in " + std::to_string(jumps) +
                          " frames, first by " + first_jump + reason);
}

}  // namespace

std::optional<DimensionlessLength> DimensionlessFront::at(DimensionlessTime time) const {
  if (samples.empty() || time < samples.front().time || time > samples.back().time)
    return std::nullopt;
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), time,
                       [](const Sample& s, DimensionlessTime t) { return s.time < t; });
  if (after->time == time) return after->position;
  const auto before = after - 1;
  const double w = part(time.value(), before->time.value(), after->time.value());
  return (1.0 - w) * before->position + w * after->position;
}

std::optional<DimensionlessTime> DimensionlessFront::arrival(DimensionlessLength level) const {
  if (samples.empty() || samples.front().position >= level) return std::nullopt;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].position < level) continue;
    const double w =
        part(level.value(), samples[i - 1].position.value(), samples[i].position.value());
    return (1.0 - w) * samples[i - 1].time + w * samples[i].time;
  }
  return std::nullopt;
}

std::optional<double> leading_edge(const ParticleFrame& frame, const Physics& physics,
                                   Metres spacing, const FrontOptions& options) {
  const double radius = 0.5 * spacing.value();
  std::optional<double> edge;
  const double direction = physics.surge_direction();
  const auto reach = [&](double x) {
    const double along = direction * x + radius;
    edge = std::max(edge.value_or(along), along);
  };
  const auto found = [&] { return edge ? std::optional(direction * *edge) : edge; };
  if (options.raw_maximum) {
    for (const Vec3& x : frame.position) reach(x[0]);
    return found();
  }
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double top = physics.floor() + options.strip_height.value() * (1.0 + 1e-9);
  const Pieces pieces = connected_pieces(frame.position, options.linking_length * spacing.value());
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    if (pieces.piece_of[i] == 0 && frame.position[i][up] <= top) reach(frame.position[i][0]);
  }
  return found();
}

FrontHistory measure_front(Run& run, const FrontOptions& options) {
  const double wall = run.physics.column_wall();
  const double direction = run.physics.surge_direction();
  const std::vector<Seconds>& times = run.frames->times();
  FrontHistory history;
  MeshFront mesh_front;
  Leads leads;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Frame frame = run.frames->read(i, Fields{});
    std::optional<double> edge;
    if (const auto* particles = std::get_if<ParticleFrame>(&frame)) {
      edge = leading_edge(*particles, run.physics, run.spacing, options);
      if (edge && run.kind == SourceKind::particle_series && !options.raw_maximum)
        leads.add(lead_of(*particles, run.physics, *edge, run.spacing, options), run.spacing);
    } else {
      edge = mesh_front.leading_edge(std::get<MeshFrame>(frame), run.physics, options);
    }
    if (!edge) break;
    history.push_back({times[i], Metres(direction * (*edge - wall))});
    if (history.size() == 1 && !options.raw_maximum) check_start(run, history.front());
  }
  if (history.empty()) {
    throw Error(run.path.string() + ": no water connected to the main body within " +
                std::to_string(options.strip_height.value()) +
                " m above the floor at the first frame");
  }
  check_speed(run, history);
  tell_course(run, history);
  leads.tell(run, history.size());
  for (const std::string& notice : run.frames->notices()) run.notices.push_back(notice);
  return history;
}

DimensionlessFront dimensionless(const FrontHistory& history, const Scales& scales) {
  DimensionlessFront front;
  for (const FrontSample& sample : history) {
    front.samples.push_back(
        {scales.dimensionless(sample.time), scales.dimensionless(sample.position)});
  }
  return front;
}

void write_front_csv(const std::filesystem::path& file, const FrontHistory& history,
                     const Scales& scales) {
  std::vector<std::vector<double>> rows;
  for (const FrontSample& sample : history) {
    rows.push_back({sample.time.value(), scales.dimensionless(sample.time).value(),
                    scales.dimensionless(sample.position).value()});
  }
  write_csv(file, {"time_s", "T", "Z_over_L"}, rows);
}

}  // namespace surge::compare
