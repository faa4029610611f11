#include "compare/measure/height.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/measure/open_space.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A function of the height that is constant between steps, and its integral.
class Layers {
 public:
  /// Adds `value` between two heights.
  void add(double lower, double upper, double value) {
    steps_.push_back({lower, value});
    steps_.push_back({upper, -value});
  }
  /// Makes the integral up to each step.
  void close() {
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.z < b.z; });
    double value = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      if (k > 0) sum += value * (steps_[k].z - steps_[k - 1].z);
      value += steps_[k].value;
      steps_[k].value = value;
      sums_.push_back(sum);
    }
  }
  [[nodiscard]] double integral(double z) const {
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), z,
                                        [](double at, const Step& s) { return at < s.z; });
    if (after == steps_.begin()) return 0.0;
    const auto k = static_cast<std::size_t>(after - steps_.begin()) - 1;
    return sums_[k] + steps_[k].value * (z - steps_[k].z);
  }
  [[nodiscard]] std::vector<double> heights() const {
    std::vector<double> z;
    for (const Step& step : steps_) z.push_back(step.z);
    return z;
  }

 private:
  struct Step {
    double z, value;
  };
  std::vector<Step> steps_;
  std::vector<double> sums_;
};

/// The vertical through a place; its window seen from above, and half of the height of the box B.
struct HeightWindow {
  Vec3 place{};
  Extent level;  ///< unbounded along the vertical and where all of the width is meant
  double half = 0.0;
  std::vector<std::size_t> axes;  ///< level ones
};

HeightWindow window_at(FrameView& view, const Place& place) {
  HeightWindow window;
  window.place.fill(unknown);
  window.place[0] = place.x;
  if (place.across && view.physics().dimension == 3) window.place[view.across()] = *place.across;
  if (!is_inside(view, window.place))
    throw Error("height of the water: found the place x = " + number_text(place.x) + " m" +
                (place.across ? ", across " + number_text(*place.across) + " m" : "") +
                " outside of the tank, expected one inside");
  const Vec3 half = resolution_at(view, window.place);
  window.half = half[view.up()];
  window.level.lower.fill(-std::numeric_limits<double>::infinity());
  window.level.upper.fill(std::numeric_limits<double>::infinity());
  for (const std::size_t a : view.axes()) {
    if (a == view.up()) continue;
    window.axes.push_back(a);
    if (!std::isfinite(window.place[a])) continue;
    window.level.lower[a] = window.place[a] - half[a];
    window.level.upper[a] = window.place[a] + half[a];
  }
  return window;
}

/// Water less half of what is open, over the height; and where the open part ends.
struct Excess {
  Layers layers;
  double lid = 0.0;
};

Excess excess_in(FrameView& view, const HeightWindow& window) {
  Excess excess;
  const std::size_t up = view.up();
  const std::vector<std::uint8_t>& settled = view.settled();
  double top = view.physics().floor();
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (settled[i] == 0) continue;
    const Extent box = view.box(i);
    const double area = shared_volume(box, window.level, window.axes);
    if (area <= 0.0) continue;
    excess.layers.add(box.lower[up], box.upper[up], area * view.fraction(i));
    top = std::max(top, box.upper[up]);
  }
  excess.lid = view.physics().floor();
  for_each_open(view, top + 4.0 * window.half, [&](const Extent& box, double part) {
    const double area = shared_volume(box, window.level, window.axes);
    if (area <= 0.0) return;
    excess.layers.add(box.lower[up], box.upper[up], -0.5 * area * part);
    if (part > 0.0) excess.lid = std::max(excess.lid, box.upper[up]);
  });
  excess.layers.close();
  return excess;
}

}  // namespace

double water_height(FrameView& view, const Place& place) {
  const HeightWindow window = window_at(view, place);
  const Excess excess = excess_in(view, window);
  const double floor = view.physics().floor();
  std::vector<double> heights{floor, excess.lid};
  for (const double z : excess.layers.heights())
    for (const double at : {z - window.half, z + window.half})
      if (at > floor && at < excess.lid) heights.push_back(at);
  std::sort(heights.begin(), heights.end());
  // The excess in the box around a height; it is linear between these heights.
  const auto at = [&](double z) {
    return excess.layers.integral(z + window.half) - excess.layers.integral(z - window.half);
  };
  double scale = 0.0;
  for (const double z : heights) scale = std::max(scale, std::abs(at(z)));
  double above = excess.lid, value_above = 0.0;
  for (std::size_t k = heights.size(); k-- > 0;) {
    const double value = at(heights[k]);
    // What rounding leaves is not water.
    if (value > 1e-9 * scale)
      return heights[k] + value / (value - value_above) * (above - heights[k]) - floor;
    above = heights[k];
    value_above = std::min(value, 0.0);
  }
  return 0.0;
}

}  // namespace surge::compare
