#include "foam_cases/text.hpp"

#include <cctype>
#include <cmath>

#include "particle/support/bounds.hpp"
#include "particle/support/error.hpp"
#include "particle/support/printable.hpp"

namespace surge::foam {

namespace {

bool is_alphanumeric(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 128;
}

}  // namespace

std::string short_text(double value) {
  if (value == 0.0 || !std::isfinite(value)) return number_text(value);
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 8.0);
  return number_text(unit < 1.0 ? std::round(value / unit) / std::round(1.0 / unit)
                                : std::round(value / unit) * unit);
}

std::string vector_text(const Point& v) {
  return "(" + number_text(v[0]) + " " + number_text(v[1]) + " " + number_text(v[2]) + ")";
}

std::string header(std::string_view kind, std::string_view object) {
  std::string text = "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       ";
  return text.append(kind).append(";\n    object      ").append(object).append(";\n}\n");
}

std::string comment(std::string_view text) {
  std::string out = printable(text);
  // A comment that ends so goes on in the next line.
  while (!out.empty() && out.back() == '\\') out.back() = '/';
  return out;
}

std::string quoted_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : comment(text)) out += c == '"' ? '\'' : c == '\\' ? '/' : c == '$' ? '_' : c;
  return out + '"';
}

std::string word(std::string_view text) {
  std::string out;
  bool raise = false;
  for (const char c : text) {
    if (!is_alphanumeric(c)) {
      raise = !out.empty();
      continue;
    }
    out += raise ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    raise = false;
  }
  if (out.empty() || std::isdigit(static_cast<unsigned char>(out[0])) != 0) out.insert(0, "at");
  return out;
}

std::string filled(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string out;
  while (!text.empty()) {
    const std::size_t at = text.find('@');
    out.append(text.substr(0, at));
    if (at == std::string_view::npos) break;
    text.remove_prefix(at + 1);
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_");
    if (end == 0 || end == std::string_view::npos || text[end] != '@') {  // no name: "$@"
      out += '@';
      continue;
    }
    const std::string name(text.substr(0, end));
    const auto found = values.find(name);
    if (found == values.end())
      throw Error("template: found @" + name + "@, expected a name that has a value");
    text.remove_prefix(end + 1);
    const bool own_line = (out.empty() || out.back() == '\n') && text.starts_with('\n');
    out.append(found->second);
    // The value of a line of its own brings its line ends along.
    if (own_line && (found->second.empty() || found->second.back() == '\n')) text.remove_prefix(1);
  }
  return out;
}

}  // namespace surge::foam
