#include "particle/support/toml_document.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "particle/support/spelling.hpp"

namespace surge {

using toml_text::describe;
using toml_text::in_quotes;
using toml_text::list_text;

namespace toml_text {

std::string in_quotes(std::string_view text) {
  return '"' + std::string(text) + '"';
}

std::string describe(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (const auto* array = node.as_array()) {
    return array->is_array_of_tables() ? "an array of tables"
                                       : "a list of " + std::to_string(array->size());
  }
  if (const auto* text = node.as_string()) return in_quotes(text->get());
  if (const auto* value = node.as_floating_point()) return number_text(value->get());
  if (const auto* value = node.as_integer()) return std::to_string(value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  return "a date or time";
}

}  // namespace toml_text

namespace {

/// Names in a dotted key; toml++ and we walk them by recursion. Nested values have its own limit.
constexpr std::size_t most_parts = 32;

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> parts;
  std::istringstream stream{std::string(path)};
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

/// The longest chain of names joined by dots outside of texts and comments. Numbers have one dot.
std::size_t longest_chain(std::string_view text) {
  std::size_t longest = 0, dots = 0;
  std::string_view quote;  // what ends the text that we are in
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (comment) {
      comment = c != '\n';
    } else if (!quote.empty()) {
      if (quote[0] == '"' && c == '\\') {
        ++i;
      } else if (text.substr(i).starts_with(quote)) {
        i += quote.size() - 1;
        quote = {};
      } else if (c == '\n' && quote.size() == 1) {
        quote = {};  // not TOML; the parser will say so
      }
    } else if (c == '"' || c == '\'') {
      const bool three = text.substr(i, 3) == std::string(3, c);
      quote = text.substr(i, three ? 3 : 1);
      i += quote.size() - 1;
    } else if (c == '#') {
      comment = true;
    } else if (c == '.') {
      longest = std::max(longest, ++dots);
    } else if (std::string_view(",[]{}=\n").find(c) != std::string_view::npos) {
      dots = 0;
    }
  }
  return longest + 1;
}

/// The value of an override as a table of the one key `value`; what is not TOML is a string.
toml::table override_value(const std::string& text) {
  try {
    if (longest_chain(text) <= most_parts && text.size() <= most_toml_bytes) {
      toml::table parsed = toml::parse("value = " + text);
      if (parsed.size() == 1 && parsed.contains("value")) return parsed;
    }
  } catch (const toml::parse_error&) {  // a bare word such as `wendland_c2`
  }
  return toml::table{{"value", text}};
}

}  // namespace

toml::table parse_bounded(std::string_view text, const std::string& source) {
  if (text.size() > most_toml_bytes)
    throw Error(source + ": found more than " + std::to_string(most_toml_bytes) +
                " bytes, expected a file of settings");
  if (const std::size_t parts = longest_chain(text); parts > most_parts)
    throw Error(source + ": found a key of " + std::to_string(parts) + " names, expected at most " +
                std::to_string(most_parts));
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    std::string reason(error.description());
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(source + ":" + std::to_string(error.source().begin.line) +
                ": found text that is not TOML (" + reason + "), expected key = value");
  }
}

/// The child of a table (made where missing) or of an array on the way to an overridden entry.
toml::node& TomlTable::Document::descend(toml::node& node, const std::string& key,
                                         const std::string& place) {
  if (auto* table = node.as_table()) {
    if (!table->contains(key)) mark(table->insert(key, toml::table{}).first->second, place);
    return *table->get(key);
  }
  if (auto* array = node.as_array()) {
    std::size_t index = 0;
    const auto [end, code] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (code == std::errc{} && end == key.data() + key.size() && index < array->size()) {
      return *array->get(index);
    }
    throw Error(place + ": found " + in_quotes(key) + ", expected an index below " +
                std::to_string(array->size()));
  }
  throw Error(place + ": found " + in_quotes(key) + " below " + describe(node) +
              ", expected a table there");
}

void TomlTable::Document::apply(const std::string& assignment) {
  const std::string place = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  const std::vector<std::string> path = split(assignment.substr(0, equals));
  const bool hollow =
      std::any_of(path.begin(), path.end(), [](const auto& part) { return part.empty(); });
  if (equals == std::string::npos || path.empty() || hollow) {
    throw Error(place + ": found " + in_quotes(assignment) + ", expected table.key=value");
  }
  if (path.size() > most_parts) {
    throw Error(place.substr(0, 60) + "...: found a key of " + std::to_string(path.size()) +
                " names, expected at most " + std::to_string(most_parts));
  }
  toml::table parsed = override_value(assignment.substr(equals + 1));
  toml::node* parent = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) parent = &descend(*parent, path[i], place);
  toml::node& value = *parsed.get("value");
  if (auto* table = parent->as_table()) {
    value.visit([&](auto& typed) { table->insert_or_assign(path.back(), std::move(typed)); });
    mark(*table->get(path.back()), place);
  } else {
    toml::node& old = descend(*parent, path.back(), place);
    auto& array = *parent->as_array();
    const auto position =
        std::find_if(array.begin(), array.end(), [&](auto& n) { return &n == &old; });
    value.visit([&](auto& typed) { mark(*array.replace(position, std::move(typed)), place); });
  }
}

void TomlTable::Document::check_all_asked(const toml::table& table, const std::string& path) const {
  static const std::set<std::string> none;
  const auto found = asked.find(&table);
  const std::set<std::string>& known = found == asked.end() ? none : found->second;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const std::string full = path.empty() ? name : path + "." + name;
    if (!known.contains(name)) {
      const bool overridden = overrides.contains(&node);
      const std::string near = nearest(name, known);
      throw Error(origin(node) + (overridden ? "" : ": " + full) + ": found unknown key " +
                  in_quotes(name) + ", expected " +
                  (!near.empty()   ? in_quotes(near)
                   : known.empty() ? "no key here"
                                   : "one of " + list_text(known)));
    }
    if (const auto* child = node.as_table()) {
      check_all_asked(*child, full);
    } else if (const auto* array = node.as_array()) {
      for (std::size_t i = 0; i < array->size(); ++i) {
        if (const auto* element = array->get(i)->as_table()) {
          check_all_asked(*element, full + "." + std::to_string(i));
        }
      }
    }
  }
}

}  // namespace surge
