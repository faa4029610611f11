#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/measure/recorded.hpp"

namespace surge::compare {

/// A column of a table that DualSPHysics' MeasureTool (5.0 to 5.4, -savecsv) has written: lines
/// ` ;PosX [m]:;0.5;...`, PosY, PosZ, then `Part;Time [s];Press_0 [Pa];...` over the values.
struct ProbeColumn {
  std::filesystem::path file;
  Vec3 place{};              ///< m, in the axes of the frames
  std::string unit;          ///< as the file has it, "Pa"
  std::vector<double> time;  ///< s, increasing
  std::vector<double> values;
};

/// Columns of a quantity ("Press", "Elevation") in all such tables in the folder of a source of
/// particle files, its folders, and those beside it where DualSPHysics' Run.out or Run.csv lies
/// there. Empty for any other source. Throws surge::Error with file:line for a damaged table.
[[nodiscard]] std::vector<ProbeColumn> measure_tool_columns(const Run& run,
                                                            const std::string& quantity);

/// The one within a tenth of a spacing of a place along some axes; empty where there is none.
/// Throws surge::Error where there are two.
[[nodiscard]] std::optional<ProbeColumn> measure_tool_column(const Run& run,
                                                             const std::string& quantity,
                                                             const Vec3& place,
                                                             const std::vector<std::size_t>& axes);

}  // namespace surge::compare
