#include "compare/study/sweep.hpp"

#include <algorithm>

#include "particle/support/spelling.hpp"

namespace surge::compare {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t most_combinations = 10000;

/// The rows of one table of lists.
std::vector<Values> rows_of(const TomlTable& table) {
  std::vector<Values> rows;
  const std::vector<std::string> keys = table.keys();
  if (keys.empty()) throw table.error("", "no list", "at least one list of values");
  for (const std::string& key : keys) {
    const std::vector<std::string> values = table.scalars(key);
    if (values.empty()) throw table.error(key, "no value", "at least one");
    if (key != keys.front() && values.size() != rows.size()) {
      throw table.error(key, std::to_string(values.size()) + " values",
                        std::to_string(rows.size()) + " as in " + keys.front() +
                            ": the lists of one table go together (for all combinations: sweep = "
                            "[{...}, {...}])");
    }
    rows.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) rows[i].emplace_back(key, values[i]);
  }
  return rows;
}

void add_dimension(std::vector<Values>& all, const TomlTable& table) {
  const std::vector<Values> rows = rows_of(table);
  if (all.size() * rows.size() > most_combinations) {
    throw table.error("", std::to_string(all.size() * rows.size()) + " combinations",
                      "at most " + std::to_string(most_combinations));
  }
  for (const auto& [key, value] : rows.front()) {
    if (std::any_of(all.front().begin(), all.front().end(),
                    [&name = key](const auto& entry) { return entry.first == name; }))
      throw table.error(key, "a second list of it", "each key once");
  }
  std::vector<Values> product;
  for (const Values& before : all) {
    for (const Values& row : rows) {
      product.push_back(before);
      product.back().insert(product.back().end(), row.begin(), row.end());
    }
  }
  all = std::move(product);
}

}  // namespace

const std::string* Combination::find(std::string_view key) const {
  for (const auto& [name, value] : values_)
    if (name == key) return &value;
  return nullptr;
}

std::string Combination::filled(const TomlTable& run, std::string_view key,
                                const std::string& text) const {
  if (empty()) return text;  // braces mean nothing without a sweep
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool twice = i + 1 < text.size() && text[i + 1] == c;
    if ((c == '{' || c == '}') && twice) {
      out += c;
      ++i;
      continue;
    }
    if (c != '{') {
      out += c;
      continue;
    }
    const auto end = text.find('}', i);
    const std::string name = text.substr(i + 1, end == std::string::npos ? end : end - i - 1);
    const std::string* value = end == std::string::npos ? nullptr : find(name);
    if (value == nullptr) {
      std::vector<std::string> known;
      std::string list;
      for (const auto& entry : values_) {
        known.push_back(entry.first);
        list += (list.empty() ? "" : ", ") + entry.first;
      }
      const std::string near = nearest(name, known);
      throw run.error(
          key, "\"" + text + "\" with {" + name + "}",
          near.empty() ? "a key of the sweep (" + list + "), or {{ for a brace" : "{" + near + "}");
    }
    out += *value;
    i = end;
  }
  return out;
}

std::vector<std::string> Combination::settings(const TomlTable& run) const {
  const std::vector<std::string> written =
      run.has("set") ? run.texts("set") : std::vector<std::string>();
  std::vector<std::string> out;
  for (const std::string& setting : written) out.push_back(filled(run, "set", setting));
  for (const auto& [key, value] : values_) {
    const bool placed =
        std::any_of(written.begin(), written.end(), [&name = key](const std::string& text) {
          return text.find("{" + name + "}") != std::string::npos;
        });
    if (key.find('.') != std::string::npos && !placed) out.push_back(key + "=" + value);
  }
  return out;
}

std::vector<Combination> read_sweep(const TomlTable& run) {
  std::vector<Values> all{Values{}};
  if (run.has_table("sweep")) {
    add_dimension(all, run.table("sweep"));
  } else if (run.has("sweep")) {
    for (const TomlTable& table : run.tables("sweep")) add_dimension(all, table);
  }
  std::vector<Combination> combinations;
  for (Values& values : all) combinations.emplace_back(std::move(values));
  return combinations;
}

}  // namespace surge::compare
