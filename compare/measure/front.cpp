#include "compare/measure/front.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "compare/measure/pieces.hpp"
#include "particle/support/error.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {
namespace {

/// Part of the way from a to b, 0 where they coincide.
double part(double value, double a, double b) {
  return b == a ? 0.0 : (value - a) / (b - a);
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
  const auto reach = [&](double x) { edge = std::max(edge.value_or(x + radius), x + radius); };
  if (options.raw_maximum) {
    for (const Vec3& x : frame.position) reach(x[0]);
    return edge;
  }
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  const double top = physics.floor() + options.strip_height.value() * (1.0 + 1e-9);
  const Pieces pieces = connected_pieces(frame.position, options.linking_length * spacing.value());
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    if (pieces.piece_of[i] == 0 && frame.position[i][up] <= top) reach(frame.position[i][0]);
  }
  return edge;
}

FrontHistory measure_front(Run& run, const FrontOptions& options) {
  const double wall = run.physics.column.lower[0];
  const std::vector<Seconds>& times = run.frames->times();
  FrontHistory history;
  MeshFront mesh_front;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Frame frame = run.frames->read(i, Fields{});
    std::optional<double> edge;
    if (const auto* particles = std::get_if<ParticleFrame>(&frame)) {
      edge = leading_edge(*particles, run.physics, run.spacing, options);
    } else {
      edge = mesh_front.leading_edge(std::get<MeshFrame>(frame), run.physics, options);
    }
    if (!edge) break;
    history.push_back({times[i], Metres(*edge - wall)});
  }
  if (history.empty()) {
    throw Error(run.path.string() + ": no water connected to the main body within " +
                std::to_string(options.strip_height.value()) +
                " m above the floor at the first frame");
  }
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
