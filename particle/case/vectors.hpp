#pragma once

#include <cmath>

#include "particle/case/motion.hpp"

namespace surge {

// Vectors of points; in 2D the third entry is zero.

[[nodiscard]] inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// a + s b
[[nodiscard]] inline Point plus(const Point& a, double s, const Point& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
[[nodiscard]] inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Of length 1; zero stays zero.
[[nodiscard]] inline Point unit(const Point& a) {
  const double norm = std::sqrt(dot(a, a));
  return norm > 0.0 ? Point{a[0] / norm, a[1] / norm, a[2] / norm} : Point{};
}

}  // namespace surge
