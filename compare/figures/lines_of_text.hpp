#pragma once

#include <string>

namespace surge::compare {

/// "MPS paper, l0 = 5 mm" in two lines, as it is wider than one of six columns.
[[nodiscard]] std::string label_in_two_lines(std::string label);

/// Words in as many lines as the width (mm) asks for, in letters of `size` points. A letter of a
/// font without serifs is 0.55 of its size wide on average. A word that is wider stays whole.
[[nodiscard]] std::string lines_within(const std::string& words, double width_mm, double size);

/// Commands of a panel that has nothing to draw: why, in its middle.
[[nodiscard]] std::string missing_panel(const std::string& why, double width_mm);

}  // namespace surge::compare
