#include "compare/figures/lines_of_text.hpp"

#include <algorithm>
#include <sstream>

#include "compare/figures/gnuplot.hpp"

namespace surge::compare {

std::string label_in_two_lines(std::string label) {
  if (const auto comma = label.find(", "); comma != std::string::npos)
    label.replace(comma, 2, "\n");
  return label;
}

std::string lines_within(const std::string& words, double width_mm, double size) {
  constexpr double point_mm = 25.4 / 72.0, letter = 0.55;
  const auto fits = static_cast<std::size_t>(std::max(1.0, width_mm / (letter * size * point_mm)));
  std::istringstream rest(words);
  std::string text, word;
  std::size_t length = 0;
  while (rest >> word) {
    if (length > 0 && length + 1 + word.size() > fits) {
      text += '\n';
      length = 0;
    } else if (length > 0) {
      text += ' ';
      ++length;
    }
    text += word;
    length += word.size();
  }
  return text;
}

std::string missing_panel(const std::string& why, double width_mm) {
  constexpr double size = 6.5;
  return "set label 3 " + plot_label(lines_within(why, width_mm, size)) +
         " at graph 0.5,0.5 center font \"," + plot_number(size) +
         "\" textcolor rgb \"#606060\"\nplot 1/0 notitle\n";
}

}  // namespace surge::compare
