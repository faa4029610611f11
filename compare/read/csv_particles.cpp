#include <algorithm>
#include <cctype>
#include <cmath>

#include "compare/read/delimited.hpp"
#include "compare/read/particle_table.hpp"
#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, std::size_t line, const std::string& what) {
  throw Error(file.string() + ":" + std::to_string(line) + ": " + what);
}

bool is_row(std::string_view line) {
  const std::string_view bare = trimmed(line);
  return !bare.empty() && bare.front() != '#' && bare.front() != '%' && bare.front() != '!';
}

/// The column with the time: the stated one, else one that is called so.
std::optional<std::size_t> time_column(const fs::path& file, const TextTable& table,
                                       const SourceOptions& options) {
  if (!options.time_array.empty()) {
    const auto column = table.find(options.time_array);
    if (!column && !table.time)
      throw Error(file.string() + ": no column \"" + options.time_array +
                  "\" found (--time-array)");
    return column;
  }
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string name = plain_name(table.columns[i]);
    for (const char* usual : {"time", "t", "timestep", "time_s", "timevalue"})
      if (name == usual) return i;
  }
  return std::nullopt;
}

/// Goes through the rows, checks that they are whole.
class Rows {
 public:
  Rows(const fs::path& file, const TextTable& table, std::uintmax_t begin, std::uintmax_t end,
       std::size_t line)
      : file_(file), table_(table), lines_(file, begin, end), line_(line - 1) {}

  bool next() {
    std::string_view line;
    do {
      begin_ = lines_.at();
      if (!lines_.next(line)) return false;
      ++line_;
    } while (!is_row(line));
    split_fields(line, table_.delimiter, fields_);
    if (fields_.size() != table_.columns.size())
      fail(file_, line_,
           std::to_string(fields_.size()) + " fields found, " +
               std::to_string(table_.columns.size()) + " expected (is the file cut short?)");
    return true;
  }

  [[nodiscard]] std::string_view field(std::size_t i) const { return fields_[i]; }
  [[nodiscard]] double number(std::size_t i) const {
    const auto value = number_in(fields_[i], table_.decimal);
    if (!value)
      fail(file_, line_,
           table_.columns[i] + ": found \"" + std::string(fields_[i]) +
               "\", expected a number such as 5.0e-02");
    return *value;
  }
  /// Whether a field begins as a word does ("fluid"), not as a number that is damaged.
  [[nodiscard]] bool is_word(std::size_t i) const {
    return !number_in(fields_[i], table_.decimal) && !fields_[i].empty() &&
           std::isalpha(static_cast<unsigned char>(fields_[i][0])) != 0;
  }
  [[nodiscard]] std::uintmax_t begin() const { return begin_; }
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] bool open_end() const { return lines_.open_end(); }

 private:
  fs::path file_;
  const TextTable& table_;
  FileLines lines_;
  std::vector<std::string_view> fields_;
  std::uintmax_t begin_ = 0;
  std::size_t line_ = 0;
};

/// The blocks of rows with one time each; times must increase.
std::vector<FilePart> parts_by_time(const fs::path& file, const TextTable& table,
                                    std::size_t column) {
  std::vector<FilePart> parts;
  Rows rows(file, table, table.begin, 0, table.line);
  while (rows.next()) {
    const double time = rows.number(column);
    if (!std::isfinite(time)) fail(file, rows.line(), "time " + number_text(time) + " found");
    if (parts.empty() || time != *parts.back().time) {
      if (!parts.empty()) {
        parts.back().end = rows.begin();
        if (time < *parts.back().time)
          fail(file, rows.line(),
               "time " + number_text(time) + " after " + number_text(*parts.back().time) +
                   ": the rows of one time together and times that increase expected (are two runs "
                   "in one file?)");
      }
      FilePart part;
      part.time = time;
      part.begin = rows.begin();
      part.line = rows.line();
      parts.push_back(part);
    }
    ++parts.back().count;
  }
  return parts;
}

}  // namespace

std::vector<FilePart> csv_parts(const fs::path& file, const SourceOptions& options) {
  const TextTable table = describe_table(file);
  if (table.columns.size() > 2 && table.columns[0] == "Part" &&
      plain_name(table.columns[1]) == "time")
    throw Error(
        file.string() +
        ": values at points over time found (a measuring tool's table), particles expected");
  if (const auto column = time_column(file, table, options)) {
    try {
      return parts_by_time(file, table, *column);
    } catch (const Error&) {
      // A column "t" may as well hold a temperature.
      if (!options.time_array.empty() || plain_name(table.columns[*column]) != "t") throw;
    }
  }
  FilePart part;
  part.time = table.time;
  part.begin = table.begin;
  part.line = table.line;
  return {part};
}

ParticleTable read_csv(const fs::path& file, const FilePart& part, const ArrayNames& wanted) {
  const TextTable layout = describe_table(file);
  ParticleTable table;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const std::string& name = layout.columns[i];
    if (std::count(layout.columns.begin(), layout.columns.end(), name) > 1 &&
        (!wanted || std::find(wanted->begin(), wanted->end(), name) != wanted->end()))
      throw Error(file.string() + ": two columns \"" + name + "\" found, one expected");
    if (wanted && std::find(wanted->begin(), wanted->end(), name) == wanted->end()) continue;
    columns.push_back(i);
    table.arrays.push_back({name, 1, "number", {}});
  }
  Rows rows(file, layout, part.begin, part.end, part.line);
  while (rows.next()) {
    ++table.count;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      ParticleArray& array = table.arrays[k];
      if (table.count == 1 ? rows.is_word(columns[k]) : array.is_text()) {
        array.add_word(std::string(rows.field(columns[k])));
      } else {
        array.values.push_back(rows.number(columns[k]));
      }
    }
  }
  if (layout.count && part.end == 0 && *layout.count != table.count)
    throw Error(file.string() + ": " + std::to_string(table.count) + " rows found, its head " +
                "announces " + std::to_string(*layout.count));
  if (layout.decimal == ',') table.notes.emplace_back("its numbers have a decimal comma");
  if (part.end == 0 && rows.open_end())
    table.notes.push_back("the last line has no end: is the file cut short?");
  return table;
}

}  // namespace surge::compare
