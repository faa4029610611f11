#pragma once

#include <algorithm>
#include <limits>

#include "particle/case/case.hpp"

namespace surge {

// Eq. (25)
/// The longest step (s) for which Cr = v_max dt / l0 stays within the Courant number of the case,
/// and never longer than its maximum.
inline double courant_step(const TimeControl& control, double spacing, double v_max) {
  const double limit =
      v_max > 0.0 ? control.courant * spacing / v_max : std::numeric_limits<double>::max();
  return std::min(limit, control.maximum_step);
}

/// The longest step (s) that keeps explicit diffusion stable, factor length^2 / nu (m, m2/s); no
/// limit without viscosity.
inline double viscous_step(double factor, double length, double nu) {
  return nu > 0.0 ? factor * length * length / nu : std::numeric_limits<double>::max();
}

}  // namespace surge
