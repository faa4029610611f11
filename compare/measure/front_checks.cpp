#include <algorithm>
#include <cmath>
#include <string>

#include "compare/measure/front.hpp"
#include "compare/read/four_digits.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {

/// Z is the distance of the front from the wall that the column stands at: the first frame must
/// show just that column, or the number means something else.
void check_front_start(const Run& run, const FrontSample& first) {
  const Physics& physics = run.physics;
  const double slack = 2.0 * run.spacing.value();
  const auto place = [](double x) { return number_text(std::round(x * 1e6) / 1e6) + " m"; };
  const double edge = first.position.value();
  const double width = physics.column_width().value();
  if (std::abs(first.time.value()) > 1e-9) {
    const auto far = physics.far_wall();
    if (physics.bed_depth() || !far || edge < far->value() - slack) return;
    throw Error(run.path.string() +
                ": first frame: the leading edge is at the far wall already; "
                "expected water on its way (water lying in the tank? --bed-depth)");
  }
  if (std::abs(edge - width) <= slack) return;
  throw Error(
      run.path.string() + ": first frame: the leading edge is " + place(edge) +
      " from the column's wall, the column " + place(width) +
      " wide; expected the edge of the column (water lying in the tank? --bed-depth says how "
      "deep; with a second body of water the leading edge is not what to measure)");
}

/// Water that falls from the height H is at most about 2 sqrt(g H) fast, and a column that has
/// collapsed for long has moved: a time step or a unit that is typed wrong shows here.
void check_front_speed(const Run& run, const FrontHistory& history) {
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
    throw Error(run.path.string() + ": the leading edge moves at up to " + four_digits(fastest) +
                " m/s, three times sqrt(2 g H) = " + four_digits(scale) +
                " m/s are expected at most (--time-step; lengths in millimetres?)");
  }
  const double moved = (history.back().position - history.front().position).value();
  const double time = (history.back().time - history.front().time).value();
  const bool long_enough = time * scale > 10.0 * height;
  const bool at_wall =
      physics.far_wall() &&
      history.back().position.value() > physics.far_wall()->value() - 4.0 * run.spacing.value();
  if (long_enough && !at_wall && moved > run.spacing.value() && moved / time < 0.03 * scale) {
    throw Error(run.path.string() + ": the leading edge needs " + four_digits(time) + " s for " +
                four_digits(moved) + " m, a collapse with sqrt(2 g H) = " + four_digits(scale) +
                " m/s is faster (--time-step)");
  }
}

}  // namespace surge::compare
