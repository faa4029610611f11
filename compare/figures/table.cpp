#include "compare/figures/table.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include "particle/support/error.hpp"

namespace surge::compare {

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
  const auto path = folder / (table.name + ".csv");
  std::ofstream out(path);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    out << (i ? "," : "") << quoted(table.columns[i]);
  }
  out << '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out << (i ? "," : "") << cell_text(row[i]);
    out << '\n';
  }
  out.close();
  if (!out) throw Error(path.string() + ": cannot be written");
}

}  // namespace surge::compare
