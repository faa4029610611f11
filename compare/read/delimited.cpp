#include "compare/read/delimited.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_head = 1 << 20;  ///< bytes that may stand before the first rows

bool is_comment(std::string_view line) {
  return line.starts_with("#") || line.starts_with("%") || line.starts_with("!") ||
         line.starts_with("//");
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// "0,5": a number with a decimal comma.
bool has_decimal_comma(std::string_view field) {
  const auto comma = field.find(',');
  return comma != std::string_view::npos && comma + 1 < field.size() &&
         is_digit(field[comma + 1]) && number_in(field, ',').has_value();
}

/// Blanks or tabs between fields whose commas are all decimal ones.
bool has_comma_decimals(std::string_view line) {
  std::vector<std::string_view> fields;
  split_fields(line, ' ', fields);
  return fields.size() > 1 && std::any_of(fields.begin(), fields.end(), has_decimal_comma) &&
         std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
           return has_decimal_comma(field) || field.find(',') == std::string_view::npos;
         });
}

char delimiter_of(std::string_view line) {
  if (line.find(';') == std::string_view::npos && has_comma_decimals(line))
    return line.find('\t') != std::string_view::npos ? '\t' : ' ';
  for (const char c : {';', ',', '\t'})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

/// A line of the head that is neither blank nor a comment.
struct HeadLine {
  std::string_view text;
  std::size_t begin = 0;
  std::size_t number = 0;  ///< in the file, from 1
  char delimiter = ',';
  char decimal = '.';
  std::vector<std::string_view> fields;
  bool numeric = false;

  [[nodiscard]] std::optional<double> value(std::size_t i) const {
    return number_in(fields[i], decimal);
  }
};

struct Head {
  std::vector<HeadLine> lines;
  std::vector<std::string_view> comments;  ///< without their sign
};

Head split_head(std::string_view text) {
  Head head;
  Lines lines(text);
  std::string_view line;
  std::size_t number = 0;
  for (std::size_t begin = 0; lines.next(line); begin = lines.at()) {
    ++number;
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    const std::string_view bare = trimmed(line);
    if (bare.empty()) continue;
    if (is_comment(bare)) {
      head.comments.push_back(
          trimmed(bare.substr(bare.find_first_not_of("#%!/ \t") == std::string_view::npos
                                  ? bare.size()
                                  : bare.find_first_not_of("#%!/ \t"))));
      continue;
    }
    HeadLine found{line, begin, number, delimiter_of(line), '.', {}, false};
    split_fields(line, found.delimiter, found.fields);
    if (std::any_of(found.fields.begin(), found.fields.end(), has_decimal_comma))
      found.decimal = ',';
    found.numeric = std::all_of(found.fields.begin(), found.fields.end(), [&](std::string_view f) {
      return number_in(f, found.decimal).has_value();
    });
    head.lines.push_back(std::move(found));
    if (head.lines.size() > 200) break;
  }
  return head;
}

/// A row holds a number at least in its first two fields, and its successor has as many fields.
bool starts_rows(const std::vector<HeadLine>& lines, std::size_t i) {
  const HeadLine& line = lines[i];
  if (line.fields.size() < 2 || line.fields[0].empty()) return false;
  const auto numbers = std::count_if(line.fields.begin(), line.fields.end(), [&](auto field) {
    return number_in(field, line.decimal).has_value();
  });
  // A column of words ("fluid") among numbers is fine.
  if (numbers < 2) return false;
  const bool named =
      i > 0 && !lines[i - 1].numeric && lines[i - 1].fields.size() == line.fields.size();
  if (i + 1 == lines.size()) return named || i == 0 || lines[i - 1].fields.size() < 2;
  const HeadLine& next = lines[i + 1];
  // Names over values above the table are followed by its names.
  if (named && next.numeric) return true;
  return next.fields.size() == line.fields.size() && next.numeric == line.numeric;
}

/// A time in a comment: "time = 0.05", "Time: 0.05 s".
std::optional<double> commented_time(std::string_view comment) {
  std::string text(comment);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const std::string name : {"time", "t"}) {
    if (!text.starts_with(name)) continue;
    const auto sign = text.find_first_not_of(" \t", name.size());
    if (sign == std::string::npos || (text[sign] != '=' && text[sign] != ':')) continue;
    std::string_view rest = trimmed(std::string_view(text).substr(sign + 1));
    if (rest.ends_with(" s")) rest = trimmed(rest.substr(0, rest.size() - 2));
    if (const auto time = number_in(rest)) return time;
    if (has_decimal_comma(rest)) return number_in(rest, ',');
  }
  return std::nullopt;
}

/// What stands above the table: a line of names over one of values, lines of one number.
void read_facts(TextTable& table, const std::vector<HeadLine>& lines, std::size_t end) {
  std::vector<double> alone;
  for (std::size_t i = 0; i < end; ++i) {
    if (lines[i].fields.size() == 1 && lines[i].numeric) {
      alone.push_back(*lines[i].value(0));
      continue;
    }
    if (i + 1 >= end || lines[i].numeric || !lines[i + 1].numeric) continue;
    for (std::size_t k = 0; k < std::min(lines[i].fields.size(), lines[i + 1].fields.size()); ++k) {
      const std::string name = plain_name(lines[i].fields[k]);
      if (name == "timestep" || name == "time") table.time = lines[i + 1].value(k);
    }
  }
  if (alone.size() == 2) table.time = alone[0];
  // One number alone is a count, unless it cannot be one.
  if (alone.size() == 1 && (alone[0] == 0.0 || alone[0] != std::round(alone[0]))) {
    table.time = alone[0];
  } else if (alone.size() == 1 || alone.size() == 2) {
    const double count = alone.back();
    if (count >= 0.0 && count == std::round(count) && count < 1e15)
      table.count = static_cast<std::size_t>(count);
  }
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return text.substr(0, 0);
  text = text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
  if (text.size() > 1 && (text.front() == '"' || text.front() == '\'') &&
      text.back() == text.front())
    text = text.substr(1, text.size() - 2);
  return text;
}

void split_fields(std::string_view line, char delimiter, std::vector<std::string_view>& fields) {
  fields.clear();
  if (delimiter == ' ') {
    for (std::size_t at = 0; at < line.size();) {
      at = line.find_first_not_of(" \t\r", at);
      if (at == std::string_view::npos) return;
      // A name in quotes may hold blanks.
      const bool quoted = line[at] == '"' && line.find('"', at + 1) != std::string_view::npos;
      const std::size_t end = quoted ? line.find('"', at + 1) + 1 : line.find_first_of(" \t\r", at);
      fields.push_back(trimmed(line.substr(at, end - at)));
      at = end == std::string_view::npos ? line.size() : end;
    }
    return;
  }
  while (true) {
    std::size_t end = line.find(delimiter);
    const std::size_t quote = line.find('"');
    if (quote < end) {
      const std::size_t closing = line.find('"', quote + 1);
      if (closing != std::string_view::npos) end = line.find(delimiter, closing);
    }
    const bool last = end == std::string_view::npos;
    const std::string_view field = trimmed(line.substr(0, end));
    if (last && field.empty() && !fields.empty()) return;
    fields.push_back(field);
    if (last) return;
    line.remove_prefix(end + 1);
  }
}

std::optional<double> number_in(std::string_view word, char decimal) {
  if (decimal == ',') {
    // One comma and no point; 1,234.5 and 1.234,5 are no numbers of a table.
    const auto comma = word.find(',');
    if (comma == std::string_view::npos)
      return word.find('.') == std::string_view::npos ? number_in(word) : std::nullopt;
    if (word.find('.') != std::string_view::npos) return std::nullopt;
    std::string plain(word);
    plain[comma] = '.';
    return number_in(plain);
  }
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty()) return std::nullopt;
  double value = 0.0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (failed == std::errc::result_out_of_range) {
    // 1e-400 is nothing but small; 1e400 is no number.
    const auto exponent = word.find_last_of("eE");
    if (exponent == std::string_view::npos || exponent + 1 >= word.size() ||
        word[exponent + 1] != '-')
      return std::nullopt;
    return 0.0;
  }
  if (failed != std::errc()) return std::nullopt;
  return value;
}

std::string without_percent(const std::string& name) {
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::from_chars(&name[i + 1], &name[i + 1] + 2, code, 16).ptr == &name[i + 1] + 2 &&
        code >= 0x20) {
      plain += static_cast<char>(code);
      i += 2;
    } else {
      plain += name[i];
    }
  }
  return plain;
}

std::string plain_name(std::string_view column) {
  const auto unit = column.find_first_of("[(");
  // "position[0]" is a component, "x [m]" a length.
  const bool index = unit != std::string_view::npos && unit + 1 < column.size() &&
                     std::isdigit(static_cast<unsigned char>(column[unit + 1])) != 0;
  std::string name(trimmed(index ? column : column.substr(0, unit)));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

std::optional<std::size_t> TextTable::find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

TextTable describe_table(const fs::path& file) {
  const std::string text = bytes_between(file, 0, longest_head);
  const Head head = split_head(text);
  std::size_t first = 0;
  while (first < head.lines.size() && !starts_rows(head.lines, first)) ++first;
  if (first == head.lines.size())
    throw Error(file.string() +
                ": no rows of numbers found, a table with a line of names (x, y, ...) expected");
  const HeadLine& row = head.lines[first];
  TextTable table;
  table.delimiter = row.delimiter;
  const bool commas = std::any_of(
      head.lines.begin() + static_cast<std::ptrdiff_t>(first), head.lines.end(),
      [&](const HeadLine& line) { return line.delimiter == row.delimiter && line.decimal == ','; });
  if (commas) table.decimal = ',';
  table.begin = row.begin;
  table.line = row.number;
  std::vector<std::string_view> names;
  std::size_t end = first;
  if (first > 0 && !head.lines[first - 1].numeric &&
      head.lines[first - 1].fields.size() == row.fields.size()) {
    names = head.lines[first - 1].fields;
    end = first - 1;
  } else if (!head.comments.empty()) {
    std::vector<std::string_view> commented;
    split_fields(head.comments.back(), delimiter_of(head.comments.back()), commented);
    if (commented.size() == row.fields.size()) names = commented;
  }
  for (std::size_t i = 0; i < row.fields.size(); ++i)
    table.columns.emplace_back(names.empty() ? std::to_string(i + 1) : std::string(names[i]));
  if (end == first && first > 0 && !head.lines[first - 1].numeric &&
      head.lines[first - 1].fields.size() > 1)
    throw Error(file.string() + ":" + std::to_string(row.number) + ": " +
                std::to_string(row.fields.size()) + " fields found, the line above has " +
                std::to_string(head.lines[first - 1].fields.size()) + " names");
  read_facts(table, head.lines, end);
  for (const std::string_view comment : head.comments)
    if (!table.time) table.time = commented_time(comment);
  return table;
}

}  // namespace surge::compare
