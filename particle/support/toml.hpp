#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge {

/// A table of a TOML file of which every entry is checked when it is read.
///
/// Whatever is wrong with an entry is a surge::Error `file:line: table.key: found X, expected Y`;
/// for an entry given on the command line `--set table.key=value: found X, expected Y`. The table
/// remembers which keys were asked for; finish() makes an error of any other. Copies refer to the
/// same document, which lives as long as any of them.
class TomlTable {
 public:
  /// Reads a file and applies overrides `table.key=value` in their order. The value is read as
  /// TOML; what is not TOML is a string. An element of an array is named by its index from 0, as
  /// in `block.0.lower=[0, 0]`; tables that are missing are made.
  static TomlTable read(const std::filesystem::path& file,
                        std::span<const std::string> overrides = {});
  /// The same for a text; `source` stands for the file's name in errors.
  static TomlTable parse(std::string_view text, std::string source,
                         std::span<const std::string> overrides = {});

  // Entries that must be there.
  [[nodiscard]] double number(std::string_view key, Bounds bounds = {}) const;
  [[nodiscard]] long integer(std::string_view key, Bounds bounds = {}) const;
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] std::string text(std::string_view key) const;
  /// The index of the entry among `names`.
  [[nodiscard]] std::size_t choice(std::string_view key,
                                   std::span<const std::string_view> names) const;
  /// A list of numbers, of exactly `length` where that is given.
  [[nodiscard]] std::vector<double> numbers(std::string_view key,
                                            std::optional<std::size_t> length = {},
                                            Bounds bounds = {}) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
  /// A text, number or truth value as text; numbers with as many digits as they need.
  [[nodiscard]] std::string scalar(std::string_view key) const;
  /// A list of them.
  [[nodiscard]] std::vector<std::string> scalars(std::string_view key) const;
  /// A number, a text, or a list of them, each as the word that a command line would hold.
  [[nodiscard]] std::vector<std::string> words(std::string_view key) const;
  /// A list of `rows` lists (of any number where that is not given) of `columns` numbers.
  [[nodiscard]] std::vector<std::vector<double>> matrix(std::string_view key,
                                                        std::optional<std::size_t> rows,
                                                        std::size_t columns) const;
  [[nodiscard]] TomlTable table(std::string_view key) const;
  /// An array of tables, [[key]]; empty where there is none.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key) const;

  // Entries that may be missing.
  [[nodiscard]] bool has(std::string_view key) const;
  /// Whether there is an entry and it is a table. Does not count as asking for it.
  [[nodiscard]] bool has_table(std::string_view key) const;
  /// Whether an entry came by an override.
  [[nodiscard]] bool overridden(std::string_view key) const;
  [[nodiscard]] double number_or(std::string_view key, double otherwise, Bounds bounds = {}) const {
    return has(key) ? number(key, bounds) : otherwise;
  }
  [[nodiscard]] long integer_or(std::string_view key, long otherwise, Bounds bounds = {}) const {
    return has(key) ? integer(key, bounds) : otherwise;
  }
  [[nodiscard]] bool boolean_or(std::string_view key, bool otherwise) const {
    return has(key) ? boolean(key) : otherwise;
  }
  [[nodiscard]] std::string text_or(std::string_view key, std::string otherwise) const {
    return has(key) ? text(key) : std::move(otherwise);
  }
  [[nodiscard]] std::optional<TomlTable> optional_table(std::string_view key) const {
    return has(key) ? std::optional(table(key)) : std::nullopt;
  }

  /// An enumerator by its name in a list of Named<E>.
  template <class Names>
  [[nodiscard]] auto enumerator(std::string_view key, const Names& names) const {
    std::vector<std::string_view> texts;
    texts.reserve(names.size());
    for (const auto& entry : names) texts.push_back(entry.name);
    return names[choice(key, texts)].value;
  }

  /// An error about an entry of this table, with its place; of the table itself for an empty key.
  [[nodiscard]] Error error(std::string_view key, std::string_view found,
                            std::string_view expected) const;
  /// The place of an entry, `file:line: table.key` or `--set table.key=value`.
  [[nodiscard]] std::string place(std::string_view key) const;
  /// The folder that file names in the document are relative to: the one the document lies in.
  [[nodiscard]] std::filesystem::path folder() const;
  /// All keys of this table, in alphabetical order. Reading them does not count as asking for them.
  [[nodiscard]] std::vector<std::string> keys() const;

  /// Throws for the first entry of the whole document (not only of this table) that nobody asked
  /// for.
  void finish() const;

 private:
  struct Document;
  struct Access;
  TomlTable(std::shared_ptr<Document> document, const void* table, std::string path);

  std::shared_ptr<Document> document_;
  const void* table_;  ///< toml::table, kept out of this header because toml++ is slow to compile
  std::string path_;   ///< dotted path from the root; empty for the root
};

}  // namespace surge
