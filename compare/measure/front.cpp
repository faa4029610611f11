#include "compare/measure/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "compare/read/four_digits.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {
namespace {

/// Part of the way from a to b, 0 where they coincide.
double part(double value, double a, double b) {
  return b == a ? 0.0 : (value - a) / (b - a);
}

/// To a hundred-thousandth of the scales, far below any spacing: what is printed beyond it would be
/// the order in which a machine adds.
std::vector<std::vector<double>> rows_of(const FrontHistory& history, const Scales& scales) {
  const auto rounded = [](double value) { return std::round(value * 1e5) / 1e5; };
  std::vector<std::vector<double>> rows;
  for (const FrontSample& sample : history)
    rows.push_back({sample.time.value(), rounded(scales.dimensionless(sample.time).value()),
                    rounded(scales.dimensionless(sample.position).value())});
  return rows;
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

std::optional<Moment<DimensionlessTime>> DimensionlessFront::arrival_moment(
    DimensionlessLength level) const {
  if (samples.empty() || samples.front().position >= level) return std::nullopt;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].position < level) continue;
    const Sample& before = samples[i - 1];
    const double w = part(level.value(), before.position.value(), samples[i].position.value());
    return Moment<DimensionlessTime>{(1.0 - w) * before.time + w * samples[i].time, before.time,
                                     samples[i].time};
  }
  return std::nullopt;
}

std::optional<DimensionlessTime> DimensionlessFront::arrival(DimensionlessLength level) const {
  const auto moment = arrival_moment(level);
  return moment ? std::optional(moment->time) : std::nullopt;
}

FrontStrip front_strip(const Physics& physics, Metres spacing, bool particles,
                       const FrontOptions& options) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Rounded places must not decide what is in the strip.
  const double strip = options.strip_height.value() * (1.0 + (particles ? 1e-9 : 1e-6));
  const double least = particles ? least_strip_spacings * spacing.value() * (1.0 + 1e-9) : 0.0;
  const double depth = physics.bed_depth().value_or(Metres(0.0)).value();
  const double floor = physics.floor();
  if (!(depth > 0.0)) {
    if (options.raw_maximum) return {-infinity, infinity};
    return {-infinity, floor + std::max(strip, least)};
  }
  if (options.raw_maximum)
    throw Error(
        "--raw-maximum: the floor is covered by water from the start, whose farthest "
        "point tells nothing; expected the front on a wet bed");
  const double height =
      physics.column.upper[static_cast<std::size_t>(physics.vertical_axis())] - floor;
  if (!std::isfinite(height))
    throw Error(
        "front on a wet bed: the height of the column is not known; expected "
        "--column-height");
  const double above = options.bed_share * (height - depth);
  if (above < spacing.value())
    throw Error("front on a wet bed: " + number_text(options.bed_share) + " of the column's " +
                four_digits(height - depth) + " m above the bed are less than a spacing of " +
                number_text(spacing.value()) +
                " m, which cannot be told from the bed; expected a finer run or a larger "
                "--bed-share");
  return {floor + depth + above, infinity};
}

std::optional<double> leading_edge(FrameView& view, const FrontOptions& options) {
  const ParticleFrame* particles = view.particles();
  const FrontStrip strip =
      front_strip(view.physics(), Metres(view.spacing()), particles != nullptr, options);
  if (particles == nullptr) return mesh_leading_edge(view, strip, options.raw_maximum);
  const double direction = view.physics().surge_direction();
  const double half = 0.5 * view.spacing();
  // Water stands higher than a level where the upper side of a particle does.
  const double above = strip.lower - half + 1e-9 * half;
  const Pieces* pieces = options.raw_maximum ? nullptr : &view.pieces(options.linking_length);
  std::optional<double> edge;
  for (std::size_t i = 0; i < particles->position.size(); ++i) {
    const Vec3& x = particles->position[i];
    if (pieces != nullptr && pieces->piece_of[i] != 0) continue;
    if (x[view.up()] <= above || x[view.up()] > strip.upper) continue;
    const double along = direction * x[0] + half;
    edge = std::max(edge.value_or(along), along);
  }
  return edge ? std::optional(direction * *edge) : edge;
}

DimensionlessFront dimensionless(const FrontHistory& history, const Scales& scales) {
  DimensionlessFront front;
  for (const FrontSample& sample : history) {
    front.samples.push_back(
        {scales.dimensionless(sample.time), scales.dimensionless(sample.position)});
  }
  return front;
}

void write_front_csv(std::ostream& out, const FrontHistory& history, const Scales& scales) {
  out << "time_s,T,Z_over_L\n";
  for (const std::vector<double>& row : rows_of(history, scales))
    out << number_text(row[0]) << ',' << number_text(row[1]) << ',' << number_text(row[2]) << '\n';
}

void write_front_csv(const std::filesystem::path& file, const FrontHistory& history,
                     const Scales& scales) {
  write_csv(file, {"time_s", "T", "Z_over_L"}, rows_of(history, scales));
}

}  // namespace surge::compare
