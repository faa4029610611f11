#include "compare/read/first_column.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "compare/read/first_frame.hpp"
#include "compare/read/foam_case.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Particles of the column: of water that lies in the tank, what stands out of it.
std::vector<Vec3> column_of(const Run& run, const ParticleFrame& frame,
                            const SourceOptions& options) {
  if (!options.bed_depth) return frame.position;
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  const double bed =
      extent_of(frame.position).lower[up] - 0.5 * run.spacing.value() + options.bed_depth->value();
  std::vector<Vec3> above;
  for (const Vec3& x : frame.position)
    if (x[up] > bed) above.push_back(x);
  if (above.empty())
    throw Error(run.path.string() + ": --bed-depth: found no water above " +
                number_text(options.bed_depth->value()) + " m, a column expected");
  return above;
}

/// Column and tank of a foreign particle series: from its first frame and from what the user says.
void apply_first_frame(Run& run, const ParticleFrame& frame, const SourceOptions& options) {
  run.method = "particles";
  run.spacing = *options.spacing;
  const auto up = static_cast<std::size_t>(options.axes ? 1 : options.vertical_axis);
  Physics& physics = run.physics;
  physics.gravity = Vec3{};
  physics.gravity[up] = -*options.gravity;
  const Extent water = extent_of(frame.position);
  physics.column = extent_of(column_of(run, frame, options));
  physics.column.lower[up] = water.lower[up];
  const bool flat = water.upper[2] - water.lower[2] < run.spacing.value();
  physics.dimension = options.dimension.value_or(flat && up != 2 ? 2 : 3);
  for (std::size_t a = 0; a < 3; ++a) {
    physics.column.lower[a] -= 0.5 * run.spacing.value();
    physics.column.upper[a] += 0.5 * run.spacing.value();
  }
}

/// The first frame's faces are where the column is measured from; one stray particle must not make
/// one.
void tell_lone_faces(Run& run, const std::vector<Vec3>& column) {
  if (column.size() < 20) return;
  const double near = 0.25 * run.spacing.value();
  for (std::size_t a = 0; a < static_cast<std::size_t>(run.physics.dimension); ++a) {
    double low = column[0][a], high = low;
    for (const Vec3& x : column) {
      low = std::min(low, x[a]);
      high = std::max(high, x[a]);
    }
    std::size_t at_low = 0, at_high = 0;
    for (const Vec3& x : column) {
      if (x[a] < low + near) ++at_low;
      if (x[a] > high - near) ++at_high;
    }
    for (const auto& [count, face] : {std::pair{at_low, low}, std::pair{at_high, high}})
      if (count == 1)
        run.notices.push_back("one particle alone makes the column's face at " + six_digits(face) +
                              " m along " + "xyz"[a] + " in the first frame");
  }
}

/// The tank: the wall behind the column and the floor under it, and what the user says; walls that
/// are not known are not finite.
Extent known_tank(const Physics& physics, const SourceOptions& options) {
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  Extent tank;
  tank.lower.fill(unknown);
  tank.upper.fill(unknown);
  tank.lower[0] = physics.column.lower[0];
  tank.lower[up] = physics.column.lower[up];
  if (options.tank_width) tank.upper[0] = tank.lower[0] + options.tank_width->value();
  if (options.tank_height) tank.upper[up] = tank.lower[up] + options.tank_height->value();
  return tank;
}

/// The centre of all but the outermost hundredth at each end of each axis: particles that were
/// thrown out say nothing about where the water went.
Vec3 centre_of(const std::vector<Vec3>& points) {
  Vec3 centre{};
  const std::size_t left_out = points.size() < 3 ? 0 : 1 + points.size() / 100;
  std::vector<double> values;
  for (std::size_t a = 0; a < 3; ++a) {
    values.clear();
    for (const Vec3& x : points) values.push_back(x[a]);
    std::sort(values.begin(), values.end());
    const std::size_t count = values.size() - 2 * left_out;
    for (std::size_t i = 0; i < count; ++i)
      centre[a] += values[left_out + i] / static_cast<double>(count);
  }
  return centre;
}

/// Water that starts at rest falls along gravity: its centre sinks along that axis and no other.
void check_fall(Run& run, const ParticleFrame& first, bool stated) {
  const std::size_t frames = run.frames->times().size();
  if (frames < 2) return;
  const auto last = std::get<ParticleFrame>(run.frames->read(frames - 1, Fields{}));
  const Vec3 a = centre_of(first.position), b = centre_of(last.position);
  const auto up = static_cast<std::size_t>(run.physics.vertical_axis());
  const double l0 = run.spacing.value();
  const double sunk = a[up] - b[up], surged = b[0] - a[0];
  const std::size_t across = 3 - up;
  const double aside = run.physics.dimension == 2 ? 0.0 : std::abs(b[across] - a[across]);
  constexpr double least = 0.2;  ///< spacings; a mean of many particles is finer than one of them
  std::string wrong;
  if (sunk < -0.5 * l0 ||
      (aside > 0.5 * l0 && aside > 4.0 * std::abs(sunk) && a[across] > b[across]))
    wrong = "it cannot rise along the axis that points up (--vertical, --axes)";
  else if (surged < -least * l0)
    wrong =
        "a column does not move towards its wall (--axes, such as -x,y, names the surge's axis)";
  else if (aside > least * l0 && aside > std::abs(surged))
    wrong = "it moves more across the surge than along it (--axes names the surge's axis)";
  if (wrong.empty()) return;
  const std::string found = "from the first frame to the last the water's centre moves by " +
                            vector_text({b[0] - a[0], b[1] - a[1], b[2] - a[2]}) + " m; " + wrong;
  // Waves and tanks that move may lift water; that is for who states the axes to know.
  if (!stated) throw Error(run.path.string() + ": " + found);
  run.notices.push_back(found);
}

void require_start(const Run& run, const std::string& option) {
  const double first = run.frames->times().front().value();
  if (std::abs(first) > 1e-12)
    throw Error(run.path.string() + ": the first time is " + number_text(first) +
                " s: the column at time 0 expected, or " + option);
}

}  // namespace

std::string vector_text(const Vec3& x) {
  std::ostringstream text;
  text << '(' << number_text(x[0]) << ", " << number_text(x[1]) << ", " << number_text(x[2]) << ')';
  return text.str();
}

Extent extent_of(const std::vector<Vec3>& points) {
  Extent box;
  box.lower.fill(std::numeric_limits<double>::infinity());
  box.upper.fill(-std::numeric_limits<double>::infinity());
  for (const Vec3& x : points)
    for (std::size_t a = 0; a < 3; ++a) {
      if (!std::isfinite(x[a])) continue;
      box.lower[a] = std::min(box.lower[a], x[a]);
      box.upper[a] = std::max(box.upper[a], x[a]);
    }
  return box;
}

void settle_column(
    Run& run, const SourceOptions& options, bool axes_stated,
    const std::function<void(Metres spacing, const std::optional<Extent>& tank)>& expect) {
  const auto frame = std::get<ParticleFrame>(run.frames->read(0, Fields{}));
  apply_first_frame(run, frame, options);
  check_first_frame(run, frame, options);
  expect(run.spacing, known_tank(run.physics, options));
  check_fall(run, frame, axes_stated);
  if (!options.column_width) require_start(run, "--column-width");
  tell_lone_faces(run, column_of(run, frame, options));
}

void apply_options(Run& run, const SourceOptions& options) {
  Physics& physics = run.physics;
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  if (options.column_width)
    physics.column.upper[0] = physics.column.lower[0] + options.column_width->value();
  if (options.column_height)
    physics.column.upper[up] = physics.column.lower[up] + options.column_height->value();
  if (options.density) physics.density = *options.density;
  if (options.bed_depth) physics.stated_bed = *options.bed_depth;
  if (options.tank_width || options.tank_height) {
    if (!physics.tank) {
      physics.tank = physics.column;
      physics.tank->upper.fill(unknown);
    }
    if (options.tank_width)
      physics.tank->upper[0] = physics.column.lower[0] + options.tank_width->value();
    if (options.tank_height)
      physics.tank->upper[up] = physics.column.lower[up] + options.tank_height->value();
  }
}

}  // namespace surge::compare
