#pragma once

#include <string_view>

namespace surge {

/// The largest count that a double tells from its neighbours.
inline constexpr double most_countable = 9007199254740992.0;

/// A number as a whole one, rounded. Throws Error where it is not finite, below zero or above
/// `most`: `what: found X, expected at most Y`. The only way from double to integer for what files
/// and formulas ask for.
[[nodiscard]] long whole_number(double value, std::string_view what, double most = most_countable);

}  // namespace surge
