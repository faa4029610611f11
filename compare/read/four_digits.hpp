#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "particle/support/bounds.hpp"

namespace surge::compare {

/// What was computed, for a sentence: to four significant digits, and no more of them than are
/// needed. What a user wrote is told by number_text(), as it was written.
[[nodiscard]] inline std::string four_digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return number_text(std::strtod(text.data(), nullptr));
}

}  // namespace surge::compare
