#pragma once

#include <string>
#include <string_view>

namespace surge {

/// A text that a terminal shows and does not obey: control characters become '?'.
[[nodiscard]] inline std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 32 || code == 127) c = '?';
  }
  return out;
}

/// The same of a text of several lines.
[[nodiscard]] inline std::string printable_lines(std::string_view text) {
  std::string out = printable(text);
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') out[i] = '\n';
  return out;
}

}  // namespace surge
