#include "particle/support/json.hpp"

#include <algorithm>

#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"
#include "particle/support/regular_file.hpp"

namespace surge {

namespace {

constexpr std::size_t most_depth = 64;  ///< of brackets; printing and comparing go by recursion
constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20U;

/// The deepest nesting of brackets outside of texts.
std::size_t depth_of(std::string_view text) {
  std::size_t depth = 0, deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

nlohmann::json parse_json(std::string_view text, const std::string& place) {
  if (const std::size_t depth = depth_of(text); depth > most_depth)
    throw Error(place + ": found brackets " + std::to_string(depth) + " deep, expected at most " +
                std::to_string(most_depth));
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {  // also a number that is too large
    throw Error(place + ": not JSON: " + printable(error.what()).substr(0, 300));
  }
}

nlohmann::json read_json(const std::filesystem::path& file) {
  return parse_json(read_regular(file, most_bytes, "a JSON file"), file.string());
}

std::string json_shown(const nlohmann::json& value) {
  constexpr std::size_t longest = 60;
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

}  // namespace surge
