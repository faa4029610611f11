#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/measure/front.hpp"
#include "compare/read/physics.hpp"

namespace surge::compare {

/// The case that a published series was measured in, in terms of the width L of its column.
struct PublishedCase {
  double column_height = 0.0;        ///< H/L
  std::optional<double> tank_width;  ///< of the far wall from the column's wall, over L; none: open
  double bed_depth = 0.0;            ///< of water that lies in the tank, over L
  std::string gate;                  ///< how the column was held and set free
  std::string axes;                  ///< what the columns of the table are
};

/// A published leading edge, as compare/reference/<name>.csv holds it.
struct PublishedSeries {
  std::string name;   ///< of the file, without .csv
  std::string label;  ///< short, for a legend
  std::string citation;
  std::string column;  ///< geometry of the column
  PublishedCase of;
  bool experiment = true;
  /// Of each value; zero for a computation.
  DimensionlessTime time_uncertainty;
  DimensionlessLength position_uncertainty;
  DimensionlessFront front;
};

/// Why a run of this physics is not of the case that a series belongs to; empty where it is. H/L,
/// the far wall and the bed's depth agree within 2 % of L, and there is one column of water at rest
/// in a tank without obstacles. What the run does not state and the series does is a reason too.
[[nodiscard]] std::optional<std::string> other_case(const PublishedSeries& series,
                                                    const Physics& physics);

/// {"column_height", "tank_width" (null: open), "bed_depth", "gate", "axes"}.
[[nodiscard]] nlohmann::json to_json(const PublishedCase& of);

/// Reads a series. Header lines `# key: value` (label, citation, column, column_height, tank_width,
/// bed_depth, gate, axes, kind = experiment | computation, time_uncertainty, position_uncertainty;
/// all required; note is optional; each once, others are errors), then `T,Z_over_L`, then two
/// finite numbers a line with T increasing. tank_width is a number, or "open" where no wall was
/// near. Throws surge::Error with file:line.
[[nodiscard]] PublishedSeries read_series(const std::filesystem::path& file);

}  // namespace surge::compare
