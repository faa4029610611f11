#include "particle/support/table.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include "particle/support/write_error.hpp"

namespace surge {

namespace {

std::string quoted(const std::string& word) {
  if (word.find_first_of(",\"\n") == std::string::npos) return word;
  std::string text = "\"";
  for (char c : word) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

std::string cell_text(const Table::Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return plot_number(*value);
  return quoted(std::get<std::string>(cell));
}

template <class Row>
void write_rows(const std::filesystem::path& file, const std::vector<std::string>& columns,
                const std::vector<Row>& rows) {
  std::ofstream out(file);
  for (std::size_t i = 0; i < columns.size(); ++i) out << (i > 0 ? "," : "") << quoted(columns[i]);
  out << '\n';
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out << (i > 0 ? "," : "") << cell_text(row[i]);
    out << '\n';
  }
  out.close();
  if (!out) throw write_error(file);
}

}  // namespace

std::string plot_number(double value) {
  if (!std::isfinite(value)) return "NaN";
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string fixed_text(double value, int decimals) {
  std::array<char, 400> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                    std::chars_format::fixed, decimals);
  return {buffer.data(), result.ptr};
}

void write_csv(const Table& table, const std::filesystem::path& folder) {
  write_rows(folder / (table.name + ".csv"), table.columns, table.rows);
}

void write_csv(const std::filesystem::path& file, const std::vector<std::string>& columns,
               const std::vector<std::vector<double>>& rows) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_rows(file, columns, rows);
}

}  // namespace surge
