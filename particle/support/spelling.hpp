#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace surge {

/// Number of edits between two words: a letter put in, left out or replaced, or two neighbouring
/// letters exchanged (optimal string alignment).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate that `word` is most likely a misspelling of; empty where none is near.
[[nodiscard]] std::string nearest(std::string_view word, const auto& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < std::max(word.size(), candidate.size())) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace surge
