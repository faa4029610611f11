#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/read/foam_case.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

/// Ends of the tank and of the water along an axis.
struct Reach {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double wet_low = low, wet_high = high;

  /// Part of the tank's length that the water covers.
  [[nodiscard]] double covered() const {
    return wet_high > wet_low ? (wet_high - wet_low) / (high - low) : 0.0;
  }
  /// Whether the water stands at the upper end and leaves the lower one dry.
  [[nodiscard]] bool is_at_upper_end() const {
    const double near = 1e-6 * (high - low);
    return wet_high > wet_low && wet_high > high - near && wet_low > low + near;
  }
};

Reach reach_of(const MeshFrame& frame, std::size_t axis) {
  Reach reach;
  for (std::size_t c = 0; c < frame.alpha.size(); ++c) {
    double b[6];
    frame.grid->GetCellBounds(static_cast<vtkIdType>(c), b);
    reach.low = std::min(reach.low, b[2 * axis]);
    reach.high = std::max(reach.high, b[2 * axis + 1]);
    if (frame.alpha[c] < 0.5) continue;
    reach.wet_low = std::min(reach.wet_low, b[2 * axis]);
    reach.wet_high = std::max(reach.wet_high, b[2 * axis + 1]);
  }
  return reach;
}

/// What the user says must fit the gravity and the plane of the case.
void check_stated(const FileAxes& stated, std::size_t up, double sign,
                  std::optional<std::size_t> empty) {
  if (stated.axis[1] == up && stated.sign[1] == sign && stated.axis[0] != empty) return;
  throw Error("axes: found \"" + stated.text() + "\", expected the axis along the surge and " +
              (sign < 0.0 ? "-" : "") + "xyz"[up] + ", which points up by the case's gravity");
}

}  // namespace

FoamAxes foam_axes(const Vec3& gravity, std::optional<std::size_t> empty, const MeshFrame& start,
                   const std::optional<FileAxes>& stated) {
  const double g = std::hypot(gravity[0], gravity[1], gravity[2]);
  std::optional<std::size_t> up;
  for (std::size_t a = 0; a < 3; ++a)
    if (g > 0.0 && std::abs(gravity[a]) >= (1.0 - 1e-9) * g) up = a;
  if (!up || up == empty) {
    throw Error("gravity: (" + number_text(gravity[0]) + " " + number_text(gravity[1]) + " " +
                number_text(gravity[2]) + ") found, a vector along x, y or z " +
                (empty ? "in the plane of the 2D case " : "") + "expected");
  }
  std::vector<std::size_t> level;
  for (std::size_t a = 0; a < 3; ++a)
    if (a != *up && a != empty) level.push_back(a);
  std::size_t surge = level.front();
  // In 3D the column spans the tank across the surge. Where that does not tell, it is the first.
  constexpr double whole = 1.0 - 1e-6;
  if (level.size() == 2 && reach_of(start, level[0]).covered() >= whole &&
      reach_of(start, level[1]).covered() < whole)
    surge = level[1];
  const double sign = gravity[*up] < 0.0 ? 1.0 : -1.0;
  double along = 1.0;
  if (stated) {
    check_stated(*stated, *up, sign, empty);
    surge = stated->axis[0];
    along = stated->sign[0];
  } else if (reach_of(start, surge).is_at_upper_end()) {
    along = -1.0;
  }
  FoamAxes axes;
  if (surge == 0 && sign > 0.0 && along > 0.0) return axes;
  const std::size_t across = 3 - surge - *up;
  // Upwards stays y where it was y, and is z otherwise.
  const std::size_t target = *up == 1 ? 1 : 2;
  axes.from = {surge, across, across};
  axes.from[target] = *up;
  axes.sign[target] = sign;
  axes.sign[0] = along;
  // The third axis makes the system right-handed.
  const bool even = (axes.from[1] + 3 - axes.from[0]) % 3 == 1;
  axes.sign[3 - target] = (even ? 1.0 : -1.0) * sign * along;
  return axes;
}

}  // namespace surge::compare
