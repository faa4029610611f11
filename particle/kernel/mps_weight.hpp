#pragma once

namespace surge {

// Eq. (3)
/// Weight function of the MPS method (Koshizuka & Oka 1996): w(r) = re/r - 1 for r < re, else 0.
/// It grows without bound as r -> 0. r > 0, same unit as re; the value is dimensionless.
inline double mps_weight(double r, double re) {
  return r < re ? re / r - 1.0 : 0.0;
}

}  // namespace surge
