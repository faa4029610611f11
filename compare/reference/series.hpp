#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/measure/front.hpp"

namespace surge::compare {

/// A published leading edge, as compare/reference/<name>.csv holds it.
struct PublishedSeries {
  std::string name;   ///< of the file, without .csv
  std::string label;  ///< short, for a legend
  std::string citation;
  std::string column;  ///< geometry of the column
  bool experiment = true;
  /// Of each value; zero for a computation.
  DimensionlessTime time_uncertainty;
  DimensionlessLength position_uncertainty;
  DimensionlessFront front;
};

/// Reads a series. Header lines `# key: value` (label, citation, column, kind = experiment |
/// computation, time_uncertainty, position_uncertainty; all required; note is optional; each once,
/// others are errors), then `T,Z_over_L`, then two finite numbers a line with T increasing. Throws
/// surge::Error with file:line.
[[nodiscard]] PublishedSeries read_series(const std::filesystem::path& file);

}  // namespace surge::compare
