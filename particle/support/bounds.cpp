#include "particle/support/bounds.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace surge {

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

bool Bounds::contain(double value) const {
  const bool above = lower_excluded ? value > lower : value >= lower;
  const bool below = upper_excluded ? value < upper : value <= upper;
  return std::isfinite(value) && above && below;
}

std::string Bounds::text() const {
  if (std::isfinite(lower) && std::isfinite(upper)) {
    const char* ends = lower_excluded && upper_excluded ? ", both excluded"
                       : lower_excluded                 ? ", the first excluded"
                       : upper_excluded                 ? ", the second excluded"
                                                        : "";
    return "between " + number_text(lower) + " and " + number_text(upper) + ends;
  }
  if (std::isfinite(lower))
    return (lower_excluded ? "above " : "of at least ") + number_text(lower);
  if (std::isfinite(upper)) return (upper_excluded ? "below " : "of at most ") + number_text(upper);
  return "";
}

}  // namespace surge
