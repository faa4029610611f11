#include "compare/figures/axis_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/figures/style.hpp"

namespace surge::compare {

std::string axis_range(const std::string& axis, const Table& table,
                       const std::vector<std::size_t>& columns) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const auto& row : table.rows) {
    for (const std::size_t column : columns) {
      const double value = std::get<double>(row[column]);
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  const bool one_value = least <= most && !(most - least > 1e-12 * std::abs(most));
  if (!one_value) return "set " + axis + "range [*:*]\n";
  const double margin = most == 0.0 ? 1.0 : 0.5 * std::abs(most);
  return "set " + axis + "range [" + plot_number(least - margin) + ":" +
         plot_number(most + margin) + "]\n";
}

}  // namespace surge::compare
