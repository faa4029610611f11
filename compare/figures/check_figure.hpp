#pragma once

#include <filesystem>
#include <vector>

#include "compare/study/baseline_check.hpp"

namespace surge::compare {

/// Draws what was found over what a baseline expects, a panel per curve: its tolerance as a band,
/// the worst point marked. Writes `file` (SVG) and nothing else. Returns gnuplot's warnings. Throws
/// surge::Error where there is no curve, or where gnuplot is missing or fails.
[[nodiscard]] std::string draw_check(const std::vector<BaselineComparison>& curves,
                                     const std::filesystem::path& file);

}  // namespace surge::compare
