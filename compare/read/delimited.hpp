#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surge::compare {

// Text tables as programs write them: CSV with `,` `;` tabs or blanks. The one home of reading
// such files.

/// Without blanks, a carriage return and the quotes around it.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The fields of a line, trimmed; a delimiter of ' ' means any number of blanks and tabs. A
/// delimiter at the end of a line ends its last field. Delimiters in quotes do not count.
void split_fields(std::string_view line, char delimiter, std::vector<std::string_view>& fields);

/// The number that a word is, "nan" and "inf" among them; empty where it is none (1.0D-02). Its
/// decimals follow after `decimal`, a point or a comma.
[[nodiscard]] std::optional<double> number_in(std::string_view word, char decimal = '.');

/// "sub dir" for "sub%20dir".
[[nodiscard]] std::string without_percent(const std::string& name);

/// Small letters without a unit: "Pos.x [m]" is "pos.x".
[[nodiscard]] std::string plain_name(std::string_view column);

/// How a text table is laid out.
struct TextTable {
  char delimiter = ',';
  char decimal = '.';
  std::vector<std::string> columns;  ///< "1", "2", ... where there is no line of names
  std::uintmax_t begin = 0;          ///< byte of the first row
  std::size_t line = 1;              ///< of the first row
  std::optional<double> time;        ///< in the head: `TimeStep [s]` over its value, `# time = x`
  std::optional<std::size_t> count;  ///< of the rows, in the head
  [[nodiscard]] std::optional<std::size_t> find(const std::string& column) const;
};

/// Looks at the head of a file: comments, lines of names and values above the table, its names.
/// Throws surge::Error where no table is found in the first lines.
[[nodiscard]] TextTable describe_table(const std::filesystem::path& file);

/// Bytes of a file from `begin` to `end` (to its end for 0).
[[nodiscard]] std::string bytes_between(const std::filesystem::path& file, std::uintmax_t begin,
                                        std::uintmax_t end);

/// Goes through the lines of a text.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  /// False at the end; a line's break is not part of it.
  bool next(std::string_view& line);
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// Goes through the lines of a file from one byte to another (the end for 0), a block in memory.
class FileLines {
 public:
  FileLines(const std::filesystem::path& file, std::uintmax_t begin, std::uintmax_t end);
  /// False at the end. The line is valid until the next call. Throws surge::Error for a line that
  /// no table has.
  bool next(std::string_view& line);
  /// The byte after the last line.
  [[nodiscard]] std::uintmax_t at() const { return at_; }
  /// Whether the last line had no break.
  [[nodiscard]] bool open_end() const { return open_end_; }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::string buffer_;
  std::size_t used_ = 0;
  std::uintmax_t at_ = 0;
  std::uintmax_t read_ = 0;
  std::uintmax_t end_ = 0;
  bool open_end_ = false;
  bool last_open_ = false;
};

}  // namespace surge::compare
