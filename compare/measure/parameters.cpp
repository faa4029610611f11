#include "compare/measure/parameters.hpp"

#include <charconv>
#include <cmath>

#include "particle/support/error.hpp"
#include "particle/support/spelling.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {

void Parameters::fail(const std::string& key, const std::string& found,
                      const std::string& expected) const {
  throw Error(source_ + ": " + key + ": found " + found + ", expected " + expected);
}

double Parameters::parse(const std::string& key, const std::string& text,
                         const Bounds& bounds) const {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    fail(key, '"' + text + '"', "a finite number");
  if (!bounds.contain(value)) fail(key, text, "a number " + bounds.text());
  return value;
}

std::optional<std::string> Parameters::text(const std::string& key) {
  taken_.insert(key);
  const auto found = entries_.find(key);
  return found == entries_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> Parameters::number(const std::string& key, const Bounds& bounds) {
  const auto found = text(key);
  return found ? std::optional(parse(key, *found, bounds)) : std::nullopt;
}

double Parameters::required(const std::string& key, const Bounds& bounds) {
  const auto found = number(key, bounds);
  if (!found) fail(key, "nothing", "a number");
  return *found;
}

std::vector<double> Parameters::numbers(const std::string& key) {
  std::vector<double> values;
  const std::string list = text(key).value_or("");
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t begin = list.find_first_not_of("; ", at);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(list.find_first_of("; ", begin), list.size());
    values.push_back(parse(key, list.substr(begin, end - begin), {}));
    at = end;
  }
  return values;
}

void Parameters::finish() const {
  for (const auto& [key, value] : entries_) {
    if (taken_.contains(key)) continue;
    const std::string known = comma_list(taken_);
    const std::string near = nearest(key, taken_);
    fail(key, "an unknown parameter",
         known.empty() ? "none" : known + (near.empty() ? "" : " (\"" + near + "\"?)"));
  }
}

}  // namespace surge::compare
