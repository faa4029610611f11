#include "compare/read/units.hpp"

#include "particle/support/error.hpp"

namespace surge::compare {

Scales::Scales(Metres column_width, double gravity)
    : column_width_(column_width),
      gravity_(gravity),
      rate_(std::sqrt(2.0 * gravity / column_width.value())) {
  if (!column_width.is_finite() || column_width.value() <= 0.0) {
    throw Error("column width: " + std::to_string(column_width.value()) +
                " m found, a positive length expected");
  }
  if (!std::isfinite(gravity) || gravity <= 0.0) {
    throw Error("gravity: " + std::to_string(gravity) + " m/s2 found, a positive number expected");
  }
}

}  // namespace surge::compare
