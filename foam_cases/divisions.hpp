#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surge::foam {

/// A place on an axis where cells must end, and what ends there.
struct Face {
  double place = 0.0;  ///< m
  std::string of;      ///< "tank", "block.0.upper"
};

/// How many cells a length holds, where that is a whole number to nine digits.
[[nodiscard]] std::optional<double> whole_cells(double length, double cell);

/// The numbers of cells per L next to `cells`, below and above, whose cells divide all lengths (m).
struct NearCells {
  std::optional<long> below;
  std::optional<long> above;
};
[[nodiscard]] NearCells near_cells(const std::vector<double>& lengths, double per, long cells);

/// What to tell about a stretch that cells of per/cells do not divide: what was found and which
/// numbers of cells divide all of the lengths.
[[nodiscard]] std::string division_error(std::string_view axis, const Face& from, const Face& to,
                                         double per, long cells,
                                         const std::vector<double>& lengths);

}  // namespace surge::foam
