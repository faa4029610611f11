#pragma once

#include <string>
#include <string_view>

namespace surge {

/// A text that a terminal shows and does not obey: control characters become '?', those of ASCII
/// and, as UTF-8 has them, those from U+0080 to U+009F, of which one begins a command like ESC [.
[[nodiscard]] inline std::string printable(std::string_view text) {
  std::string out(text);
  char before = ' ';
  for (char& c : out) {
    const auto code = static_cast<unsigned char>(c);
    const bool second = before == '\xC2' && code < 0xA0;
    if (second) (&c)[-1] = '?';
    if (code < 32 || code == 127 || second) c = '?';
    before = c;
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
