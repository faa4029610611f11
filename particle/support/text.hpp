#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace surge {

/// "a, b, c": words of any range of texts.
[[nodiscard]] std::string comma_list(const auto& words) {
  std::string text;
  for (const auto& word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

/// The same word in small letters (ASCII).
[[nodiscard]] inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace surge
