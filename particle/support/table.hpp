#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace surge {

/// Data of a figure, one value or word per cell, written as CSV beside it.
struct Table {
  using Cell = std::variant<double, std::string>;

  std::string name;  ///< file stem; the file is NAME.csv
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;

  void add(std::vector<Cell> row) { rows.push_back(std::move(row)); }
};

/// Shortest text that reads back as the same double; "NaN" where the value is not finite, because
/// gnuplot takes that as a gap.
[[nodiscard]] std::string plot_number(double value);

/// The value with a fixed number of decimals, for people; "not available" is the caller's business.
[[nodiscard]] std::string fixed_text(double value, int decimals);

/// Writes folder/NAME.csv (RFC 4180: words with commas or quotes are quoted). Throws Error.
void write_csv(const Table& table, const std::filesystem::path& folder);

/// Rows of finite numbers under a header, enough digits to read the same doubles back; makes the
/// folder of the file. Throws Error.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
               const std::vector<std::vector<double>>& rows);

}  // namespace surge
