#include "particle/support/toml.hpp"

#include <algorithm>

#include "particle/support/regular_file.hpp"
#include "particle/support/spelling.hpp"
#include "particle/support/toml_document.hpp"

namespace surge {

using toml_text::describe;
using toml_text::in_quotes;
using toml_text::list_text;

namespace {

std::optional<double> as_number(const toml::node& node) {
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_integer()) return static_cast<double>(value->get());
  return std::nullopt;
}

std::optional<std::string> as_scalar(const toml::node& node) {
  if (const auto* value = node.as_string()) return value->get();
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (const auto* value = node.as_integer()) return std::to_string(value->get());
  if (const auto* value = node.as_floating_point()) return number_text(value->get());
  return std::nullopt;
}

std::string with_bounds(std::string_view noun, Bounds bounds) {
  const std::string limits = bounds.text();
  return std::string(noun) + (limits.empty() ? "" : " " + limits);
}

const toml::table& as_table(const void* table) {
  return *static_cast<const toml::table*>(table);
}

}  // namespace

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
  return parse(read_regular(file, most_toml_bytes, "a TOML file"), file.string(), overrides);
}

TomlTable TomlTable::parse(std::string_view text, std::string source,
                           std::span<const std::string> overrides) {
  auto document = std::make_shared<Document>();
  document->source = std::move(source);
  document->root = parse_bounded(text, document->source);
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

std::string TomlTable::scalar(std::string_view key) const {
  const std::string expected = "a text, a number, true or false";
  const toml::node& node = Access::require(*this, key, expected);
  const auto value = as_scalar(node);
  if (!value) throw error(key, describe(node), expected);
  return *value;
}

std::vector<std::string> TomlTable::scalars(std::string_view key) const {
  const std::string expected = "a list of texts, numbers or truth values";
  std::vector<std::string> values;
  for (const toml::node& element : Access::array(*this, key, expected)) {
    const auto value = as_scalar(element);
    if (!value) throw error(key, describe(element) + " in the list", expected);
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string> TomlTable::words(std::string_view key) const {
  const std::string expected = "a number, a text, or a list of them";
  const toml::node& node = Access::require(*this, key, expected);
  std::vector<std::string> words;
  const auto add = [&](const toml::node& element) {
    if (element.is_string()) {
      words.push_back(element.as_string()->get());
    } else if (element.is_integer()) {
      words.push_back(std::to_string(element.as_integer()->get()));
    } else if (const auto value = as_number(element)) {
      words.push_back(number_text(*value));
    } else {
      throw error(key, describe(element), expected);
    }
  };
  if (const toml::array* list = node.as_array()) {
    for (const toml::node& element : *list) add(element);
  } else {
    add(node);
  }
  return words;
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

bool TomlTable::has_table(std::string_view key) const {
  const toml::node* node = as_table(table_).get(key);
  return node != nullptr && node->is_table();
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
