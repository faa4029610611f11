#include "compare/read/foam_data.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "compare/read/foam_file.hpp"

namespace surge::compare {
namespace {

constexpr std::string_view punctuation = "{}()[];";
constexpr std::uint64_t most_entries = std::uint64_t{1} << 32U;

bool is_blank(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

/// "label=32" in the entry `arch`.
int bits_of(std::string_view arch, std::string_view key, int usual) {
  const auto at = arch.find(key);
  if (at == std::string_view::npos) return usual;
  int bits = 0;
  const std::string_view digits = arch.substr(at + key.size());
  std::from_chars(digits.data(), digits.data() + digits.size(), bits);
  return bits;
}

template <class T>
T value_at(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// A word as messages show it.
std::string shown(std::string_view word) {
  std::string text = "\"";
  text.append(word.substr(0, 40)).append("\"");
  return text;
}

}  // namespace

void FoamCursor::fail(const std::string& message) const {
  const std::size_t end = std::min(at_, text_.size());
  const auto line =
      1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  throw Error(place_ + ":" + std::to_string(line) + ": " + message);
}

void FoamCursor::cut_short(const std::string& what) const {
  throw FoamCutShort(place_ + ": ends before " + what + " (cut short, or still being written?)");
}

void FoamCursor::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (text_.compare(at_, 2, "//") == 0) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (text_.compare(at_, 2, "/*") == 0) {
      const auto end = text_.find("*/", at_ + 2);
      if (end == std::string_view::npos) cut_short("its comment does");
      at_ = end + 2;
    } else {
      return;
    }
  }
}

bool FoamCursor::at_end() {
  skip_blanks();
  return at_ >= text_.size();
}

char FoamCursor::peek() {
  return at_end() ? '\0' : text_[at_];
}

std::string_view FoamCursor::token() {
  if (at_end()) return {};
  const std::size_t begin = at_;
  if (text_[at_] == '"') {
    const auto end = text_.find('"', at_ + 1);
    if (end == std::string_view::npos) cut_short("a string in quotes does");
    at_ = end + 1;
    return text_.substr(begin + 1, end - begin - 1);
  }
  if (punctuation.find(text_[at_]) != std::string_view::npos) return text_.substr(at_++, 1);
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '"' &&
         punctuation.find(text_[at_]) == std::string_view::npos)
    ++at_;
  return text_.substr(begin, at_ - begin);
}

void FoamCursor::expect(std::string_view expected) {
  if (at_end()) cut_short(shown(expected));
  const std::string_view found = token();
  if (found != expected) {
    fail(shown(found) + " found, " + shown(expected) + " expected");
  }
}

double FoamCursor::number() {
  if (at_end()) cut_short("a number");
  const std::string_view word = token();
  double value = 0.0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc{} || end != word.data() + word.size())
    fail(shown(word) + " found, a number expected");
  if (!std::isfinite(value)) fail(shown(word) + " found, not finite");
  // A file that ends within a number must not give a shorter one.
  if (at_ >= text_.size()) cut_short("its numbers do");
  return value;
}

std::uint64_t FoamCursor::count() {
  if (at_end()) cut_short("a number of values");
  const std::string_view word = token();
  std::uint64_t value = 0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc{} || end != word.data() + word.size())
    fail(shown(word) + " found, a number of values expected");
  if (value > most_entries) fail(std::to_string(value) + " values found, fewer expected");
  return value;
}

FoamHeader FoamCursor::header(const FoamHeader& usual) {
  skip_blanks();
  const std::size_t before = at_;
  if (token() != "FoamFile") {
    at_ = before;
    return usual;
  }
  FoamHeader header;
  expect("{");
  while (peek() != '}') {
    if (at_end()) cut_short("its header does");
    const std::string key(token());
    const std::string value(token());
    if (key == "format" || key == "data.format") header.binary = value == "binary";
    if (key == "class") header.type = value;
    if (key == "data.class") header.inner_type = value;
    if (key == "location") header.location = value;
    if (key == "note") header.note = value;
    if (key == "arch") {
      if (value.starts_with("MSB") && std::endian::native == std::endian::little)
        fail("numbers of a machine with the other byte order (arch MSB), LSB expected");
      header.label_bytes = bits_of(value, "label=", 32) / 8;
      header.scalar_bytes = bits_of(value, "scalar=", 64) / 8;
      const bool known = (header.label_bytes == 4 || header.label_bytes == 8) &&
                         (header.scalar_bytes == 4 || header.scalar_bytes == 8);
      if (!known) fail("arch " + shown(value) + " found, 32 or 64 bits expected");
    }
    while (peek() != ';' && !at_end()) (void)token();
    expect(";");
  }
  expect("}");
  return header;
}

std::string_view FoamCursor::raw(std::uint64_t bytes) {
  if (bytes > text_.size() - std::min(at_, text_.size())) cut_short("its values do");
  const std::string_view part = text_.substr(at_, static_cast<std::size_t>(bytes));
  at_ += part.size();
  return part;
}

FoamCursor::ListStart FoamCursor::list_start(std::size_t bytes_each) {
  ListStart start;
  start.counted = peek() != '(';
  if (start.counted) start.size = count();
  if (start.size > text_.size() / bytes_each && (at_end() || text_[at_] != '{'))
    cut_short(std::to_string(start.size) + " values");
  const char next = peek();
  if (next == '(' || next == '{') {
    start.bracket = next;
    ++at_;
  } else if (start.size > 0) {
    if (at_end()) cut_short("its list does");
    fail("a list expected");
  }
  return start;
}

void FoamCursor::ascii_scalars(std::vector<double>& values, std::size_t components) {
  if (components > 1) expect("(");
  for (std::size_t k = 0; k < components; ++k) values.push_back(number());
  if (components > 1) expect(")");
}

std::vector<double> FoamCursor::scalars(const FoamHeader& header, std::size_t components) {
  const auto each = components * static_cast<std::size_t>(header.scalar_bytes);
  // The shortest number in ascii is a digit with a blank.
  const ListStart start = list_start(header.binary ? each : 2 * components);
  std::vector<double> values;
  const auto take = [&](std::uint64_t count) {
    const std::string_view part = raw(count * each);
    for (std::size_t at = 0; at < part.size();
         at += static_cast<std::size_t>(header.scalar_bytes)) {
      values.push_back(header.scalar_bytes == 8
                           ? value_at<double>(part.data() + at)
                           : static_cast<double>(value_at<float>(part.data() + at)));
      if (!std::isfinite(values.back()))
        fail("value " + std::to_string(values.size() / components) + " is not finite");
    }
  };
  if (start.bracket == '{') {
    if (start.size * components > most_foam_bytes / sizeof(double)) fail("a smaller list expected");
    header.binary ? take(1) : ascii_scalars(values, components);
    expect("}");
    const std::vector<double> one(values.begin(), values.end());
    values.clear();
    values.reserve(static_cast<std::size_t>(start.size) * components);
    for (std::uint64_t i = 0; i < start.size; ++i)
      values.insert(values.end(), one.begin(), one.end());
  } else if (start.bracket == '(') {
    values.reserve(static_cast<std::size_t>(start.size) * components);
    if (header.binary && start.size > 0)
      take(start.size);
    else if (start.counted)
      for (std::uint64_t i = 0; i < start.size; ++i) ascii_scalars(values, components);
    else
      while (peek() != ')') ascii_scalars(values, components);
    expect(")");
  }
  return values;
}

std::vector<std::int64_t> FoamCursor::labels(const FoamHeader& header) {
  const auto each = static_cast<std::size_t>(header.label_bytes);
  const ListStart start = list_start(header.binary ? each : 2);
  std::vector<std::int64_t> values;
  const auto one = [&] {
    const std::string_view word = token();
    std::int64_t value = 0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || at_ >= text_.size()) cut_short("its list does");
    if (failed != std::errc{} || end != word.data() + word.size())
      fail(shown(word) + " found, a whole number expected");
    values.push_back(value);
  };
  if (start.bracket == '{') {
    if (start.size > most_foam_bytes / sizeof(std::int64_t)) fail("a smaller list expected");
    if (header.binary) fail("a repeated label in binary found, a list expected");
    one();
    expect("}");
    values.assign(static_cast<std::size_t>(start.size), values.front());
  } else if (start.bracket == '(') {
    values.reserve(static_cast<std::size_t>(start.size));
    if (header.binary && start.size > 0) {
      const std::string_view part = raw(start.size * each);
      for (std::size_t at = 0; at < part.size(); at += each) {
        values.push_back(each == 8 ? value_at<std::int64_t>(part.data() + at)
                                   : std::int64_t{value_at<std::int32_t>(part.data() + at)});
      }
    } else if (start.counted) {
      for (std::uint64_t i = 0; i < start.size; ++i) one();
    } else {
      while (peek() != ')') one();
    }
    expect(")");
  }
  return values;
}

std::string_view FoamCursor::bytes() {
  const ListStart start = list_start(1);
  if (start.bracket == '\0') return {};
  if (start.bracket != '(' || !start.counted) fail("a block of bytes expected");
  const std::string_view part = raw(start.size);
  expect(")");
  return part;
}

void FoamCursor::skip_value(const FoamHeader& header) {
  int depth = 0;
  while (true) {
    if (at_end()) cut_short("its entry does");
    const std::string_view word = token();
    if (word == ";" && depth == 0) return;
    if (word == "{" || word == "(" || word == "[") ++depth;
    if (word == "}" || word == ")" || word == "]") --depth;
    if (depth < 0) fail(shown(word) + " found, the ; of the entry expected");
    if (!header.binary || !word.starts_with("List<")) continue;
    const std::string_view type = word.substr(5);
    const std::size_t components = type.starts_with("vector")       ? 3
                                   : type.starts_with("symmTensor") ? 6
                                   : type.starts_with("tensor")     ? 9
                                                                    : 1;
    if (type.starts_with("label") || type.starts_with("bool")) {
      (void)labels(header);
    } else {
      (void)scalars(header, components);
    }
  }
}

std::vector<FoamBlock> foam_blocks(std::string_view text, const std::string& place) {
  FoamCursor cursor(text, place);
  const FoamHeader outer = cursor.header();
  if (outer.type != "decomposedBlockData")
    throw Error(place + ": class " + outer.type + " found, decomposedBlockData expected");
  std::vector<FoamBlock> blocks;
  FoamHeader common = outer;
  common.type = outer.inner_type;
  while (!cursor.at_end()) {
    const std::string_view part = cursor.bytes();
    FoamCursor inside(part, place + ", block " + std::to_string(blocks.size()));
    // Only the first block has to have a header of its own.
    const FoamHeader header = part.empty() ? common : inside.header(common);
    blocks.push_back({part, header});
    // The counts in its note are those of the first block.
    if (blocks.size() == 1) common = header;
    common.note.clear();
  }
  return blocks;
}

}  // namespace surge::compare
