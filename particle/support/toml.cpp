#include "particle/support/toml.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "particle/support/spelling.hpp"

namespace surge {

namespace {

std::string in_quotes(std::string_view text) {
  return '"' + std::string(text) + '"';
}

std::string list_text(const auto& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + in_quotes(name);
  return text;
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

std::optional<double> as_number(const toml::node& node) {
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_integer()) return static_cast<double>(value->get());
  return std::nullopt;
}

std::string with_bounds(std::string_view noun, Bounds bounds) {
  const std::string limits = bounds.text();
  return std::string(noun) + (limits.empty() ? "" : " " + limits);
}

const toml::table& as_table(const void* table) {
  return *static_cast<const toml::table*>(table);
}

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> parts;
  std::istringstream stream{std::string(path)};
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

/// The value of an override as a table of the one key `value`; what is not TOML is a string.
toml::table override_value(const std::string& text) {
  try {
    toml::table parsed = toml::parse("value = " + text);
    if (parsed.size() == 1 && parsed.contains("value")) return parsed;
  } catch (const toml::parse_error&) {  // a bare word such as `wendland_c2`
  }
  return toml::table{{"value", text}};
}

}  // namespace

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

/// The steps that all getters share.
struct TomlTable::Access {
  static const toml::node* find(const TomlTable& table, std::string_view key) {
    table.document_->asked[&as_table(table.table_)].emplace(key);
    return as_table(table.table_).get(key);
  }

  static const toml::node& require(const TomlTable& table, std::string_view key,
                                   std::string_view expected) {
    if (const toml::node* node = find(table, key)) return *node;
    std::vector<std::string> others = table.keys();
    std::erase_if(others, [&](const auto& other) {
      return table.document_->asked[&as_table(table.table_)].contains(other);
    });
    const std::string near = nearest(key, others);
    throw table.error(
        key, near.empty() ? "no such key" : "no such key (but " + in_quotes(near) + ")", expected);
  }

  static const toml::array& array(const TomlTable& table, std::string_view key,
                                  std::string_view expected,
                                  std::optional<std::size_t> length = {}) {
    const toml::node& node = require(table, key, expected);
    const toml::array* list = node.as_array();
    if (list == nullptr || (length && list->size() != *length)) {
      throw table.error(key, describe(node), expected);
    }
    return *list;
  }

  static std::vector<double> numbers(const TomlTable& table, std::string_view key,
                                     const toml::array& list, Bounds bounds) {
    std::vector<double> values;
    for (const toml::node& element : list) {
      const auto value = as_number(element);
      if (!value || !bounds.contain(*value)) {
        throw table.error(key, describe(element) + " in the list", with_bounds("a number", bounds));
      }
      values.push_back(*value);
    }
    return values;
  }
};

TomlTable::TomlTable(std::shared_ptr<Document> document, const void* table, std::string path)
    : document_(std::move(document)), table_(table), path_(std::move(path)) {}

TomlTable TomlTable::read(const std::filesystem::path& file,
                          std::span<const std::string> overrides) {
  std::ifstream stream(file);
  if (!std::filesystem::is_regular_file(file) || !stream) {
    throw Error(file.string() + ": found no readable file, expected a TOML file");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return parse(text.str(), file.string(), overrides);
}

TomlTable TomlTable::parse(std::string_view text, std::string source,
                           std::span<const std::string> overrides) {
  auto document = std::make_shared<Document>();
  document->source = std::move(source);
  try {
    document->root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    std::string reason(error.description());
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(document->source + ":" + std::to_string(error.source().begin.line) +
                ": found text that is not TOML (" + reason + "), expected key = value");
  }
  for (const std::string& assignment : overrides) document->apply(assignment);
  const toml::table* root = &document->root;
  return {std::move(document), root, ""};
}

double TomlTable::number(std::string_view key, Bounds bounds) const {
  const std::string expected = with_bounds("a number", bounds);
  const toml::node& node = Access::require(*this, key, expected);
  const auto value = as_number(node);
  if (!value || !bounds.contain(*value)) throw error(key, describe(node), expected);
  return *value;
}

long TomlTable::integer(std::string_view key, Bounds bounds) const {
  const std::string expected = with_bounds("a whole number", bounds);
  const toml::node& node = Access::require(*this, key, expected);
  const auto* value = node.as_integer();
  if (value == nullptr || !bounds.contain(static_cast<double>(value->get()))) {
    throw error(key, describe(node), expected);
  }
  return value->get();
}

bool TomlTable::boolean(std::string_view key) const {
  const toml::node& node = Access::require(*this, key, "true or false");
  if (!node.is_boolean()) throw error(key, describe(node), "true or false");
  return node.as_boolean()->get();
}

std::string TomlTable::text(std::string_view key) const {
  const toml::node& node = Access::require(*this, key, "a text");
  if (!node.is_string()) throw error(key, describe(node), "a text");
  return node.as_string()->get();
}

std::size_t TomlTable::choice(std::string_view key, std::span<const std::string_view> names) const {
  const std::string expected = "one of " + list_text(names);
  const toml::node& node = Access::require(*this, key, expected);
  const auto* value = node.as_string();
  const auto found =
      value == nullptr ? names.end() : std::find(names.begin(), names.end(), value->get());
  if (found == names.end()) throw error(key, describe(node), expected);
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<double> TomlTable::numbers(std::string_view key, std::optional<std::size_t> length,
                                       Bounds bounds) const {
  const std::string expected =
      "a list of " + (length ? std::to_string(*length) + " " : std::string()) + "numbers";
  return Access::numbers(*this, key, Access::array(*this, key, expected, length), bounds);
}

std::vector<std::string> TomlTable::texts(std::string_view key) const {
  std::vector<std::string> values;
  for (const toml::node& element : Access::array(*this, key, "a list of texts")) {
    if (!element.is_string()) throw error(key, describe(element) + " in the list", "a text");
    values.push_back(element.as_string()->get());
  }
  return values;
}

std::vector<std::vector<double>> TomlTable::matrix(std::string_view key,
                                                   std::optional<std::size_t> rows,
                                                   std::size_t columns) const {
  const std::string expected = (rows ? std::to_string(*rows) : std::string("a list of")) +
                               " lists of " + std::to_string(columns) + " numbers";
  std::vector<std::vector<double>> values;
  for (const toml::node& element : Access::array(*this, key, expected, rows)) {
    const toml::array* row = element.as_array();
    if (row == nullptr || row->size() != columns) {
      throw error(key, describe(element) + " in the list", expected);
    }
    values.push_back(Access::numbers(*this, key, *row, {}));
  }
  return values;
}

TomlTable TomlTable::table(std::string_view key) const {
  const toml::node& node = Access::require(*this, key, "a table");
  if (!node.is_table()) throw error(key, describe(node), "a table");
  return {document_, node.as_table(),
          path_.empty() ? std::string(key) : path_ + "." + std::string(key)};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  const std::string expected = "an array of tables [[" + std::string(key) + "]]";
  const toml::node* node = Access::find(*this, key);
  if (node == nullptr) return {};
  const toml::array* list = node->as_array();
  if (list == nullptr || (!list->empty() && !list->is_array_of_tables())) {
    throw error(key, describe(*node), expected);
  }
  std::vector<TomlTable> elements;
  const std::string path = (path_.empty() ? "" : path_ + ".") + std::string(key) + ".";
  for (std::size_t i = 0; i < list->size(); ++i) {
    elements.push_back(TomlTable(document_, list->get(i)->as_table(), path + std::to_string(i)));
  }
  return elements;
}

bool TomlTable::has(std::string_view key) const {
  return Access::find(*this, key) != nullptr;
}

bool TomlTable::overridden(std::string_view key) const {
  const toml::node* node = as_table(table_).get(key);
  return node != nullptr && document_->overrides.contains(node);
}

std::string TomlTable::place(std::string_view key) const {
  const toml::table& table = as_table(table_);
  const std::string full = key.empty()     ? path_
                           : path_.empty() ? std::string(key)
                                           : path_ + "." + std::string(key);
  const toml::node* node = key.empty() ? &table : table.get(key);
  if (node != nullptr && document_->overrides.contains(node)) return document_->origin(*node);
  const std::string origin = document_->origin(node == nullptr ? table : *node);
  return full.empty() ? origin : origin + ": " + full;
}

Error TomlTable::error(std::string_view key, std::string_view found,
                       std::string_view expected) const {
  return Error(place(key) + ": found " + std::string(found) + ", expected " +
               std::string(expected));
}

std::filesystem::path TomlTable::folder() const {
  return std::filesystem::path(document_->source).parent_path();
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, node] : as_table(table_)) names.emplace_back(key.str());
  return names;
}

void TomlTable::finish() const {
  document_->check_all_asked(document_->root, "");
}

}  // namespace surge
