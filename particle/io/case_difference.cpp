#include "particle/io/case_difference.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace surge {

namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view free_key = "output.checkpoint";
constexpr std::size_t longest = 60;  ///< characters of a value that are shown

/// Keys with their tables, tables of a list with their number, in the order of the text.
Entries entries_of(std::string_view text) {
  Entries entries;
  std::map<std::string, int> tables;
  std::string prefix;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[[")) {
      const std::string name = line.substr(2, line.find(']') - 2);
      prefix = name + '.' + std::to_string(tables[name]++) + '.';
    } else if (line.starts_with('[')) {
      prefix = line.substr(1, line.find(']') - 1) + '.';
    } else if (const std::size_t equals = line.find(" = "); equals != std::string::npos) {
      const std::string key = prefix + line.substr(0, equals);
      if (key != free_key) entries.emplace_back(key, line.substr(equals + 3));
    }
  }
  return entries;
}

std::string shown(const std::string& value) {
  return value.size() <= longest ? value : value.substr(0, longest) + "...";
}

std::string value_of(const Entries& entries, const std::string& key) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const auto& entry) { return entry.first == key; });
  return found == entries.end() ? "nothing" : shown(found->second);
}

}  // namespace

std::optional<CaseDifference> case_difference(std::string_view first, std::string_view second) {
  const Entries a = entries_of(first);
  const Entries b = entries_of(second);
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (x == a.end() && y == b.end()) return std::nullopt;
  // Where one lacks the entry, the other's key is the one to name.
  const bool extra = x == a.end() || (y != b.end() && value_of(a, y->first) == "nothing");
  const std::string key = extra ? y->first : x->first;
  return CaseDifference{key, value_of(a, key), value_of(b, key)};
}

}  // namespace surge
