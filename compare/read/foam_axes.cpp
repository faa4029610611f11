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

/// Part of the tank's length along an axis that the water covers.
double covered(const MeshFrame& frame, std::size_t axis) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double low = infinite, high = -infinite, wet_low = infinite, wet_high = -infinite;
  for (std::size_t c = 0; c < frame.alpha.size(); ++c) {
    double b[6];
    frame.grid->GetCellBounds(static_cast<vtkIdType>(c), b);
    low = std::min(low, b[2 * axis]);
    high = std::max(high, b[2 * axis + 1]);
    if (frame.alpha[c] < 0.5) continue;
    wet_low = std::min(wet_low, b[2 * axis]);
    wet_high = std::max(wet_high, b[2 * axis + 1]);
  }
  return wet_high > wet_low ? (wet_high - wet_low) / (high - low) : 0.0;
}

}  // namespace

FoamAxes foam_axes(const Vec3& gravity, std::optional<std::size_t> empty, const MeshFrame& start) {
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
  if (level.size() == 2 && covered(start, level[0]) >= whole && covered(start, level[1]) < whole)
    surge = level[1];
  const double sign = gravity[*up] < 0.0 ? 1.0 : -1.0;
  FoamAxes axes;
  if (surge == 0 && sign > 0.0) return axes;
  const std::size_t across = 3 - surge - *up;
  // Upwards stays y where it was y, and is z otherwise.
  const std::size_t target = *up == 1 ? 1 : 2;
  axes.from = {surge, across, across};
  axes.from[target] = *up;
  axes.sign[target] = sign;
  // The third axis makes the system right-handed.
  const bool even = (axes.from[1] + 3 - axes.from[0]) % 3 == 1;
  axes.sign[3 - target] = (even ? 1.0 : -1.0) * sign;
  return axes;
}

}  // namespace surge::compare
