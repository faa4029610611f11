#pragma once

#include <toml++/toml.h>

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "particle/support/toml.hpp"

namespace surge {

// What is behind TomlTable; for toml.cpp alone, because toml++ is slow to compile.

namespace toml_text {

[[nodiscard]] std::string in_quotes(std::string_view text);
[[nodiscard]] std::string list_text(const auto& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + in_quotes(name);
  return text;
}
/// A node as errors show it.
[[nodiscard]] std::string describe(const toml::node& node);

}  // namespace toml_text

/// A parsed file with overrides, and what was asked of it.
struct TomlTable::Document {
  std::string source;
  toml::table root;
  std::map<const toml::node*, std::string> overrides;          ///< nodes that came by --set
  std::map<const toml::node*, std::set<std::string>> asked{};  ///< keys asked for, by table

  void mark(const toml::node& node, const std::string& text) {
    overrides[&node] = text;
    if (const auto* table = node.as_table()) {
      for (const auto& [key, child] : *table) mark(child, text);
    } else if (const auto* array = node.as_array()) {
      for (const auto& child : *array) mark(child, text);
    }
  }

  [[nodiscard]] std::string origin(const toml::node& node) const {
    if (const auto found = overrides.find(&node); found != overrides.end()) return found->second;
    return source + ":" + std::to_string(std::max<unsigned>(1, node.source().begin.line));
  }

  void apply(const std::string& assignment);
  [[nodiscard]] toml::node& descend(toml::node& node, const std::string& key,
                                    const std::string& place);
  void check_all_asked(const toml::table& table, const std::string& path) const;
};

/// Parses a text whose size and depth are bounded, so that no input exhausts memory or stack.
/// Throws Error.
[[nodiscard]] toml::table parse_bounded(std::string_view text, const std::string& source);

/// The largest file that is read, in bytes.
inline constexpr std::size_t most_toml_bytes = 3 * 1024 * 1024;

}  // namespace surge
