#include "compare/commands/tolerances.hpp"

#include <charconv>
#include <cmath>

#include "particle/support/error.hpp"

namespace surge::compare {

std::map<std::string, double> read_tolerances(const std::string& option,
                                              const std::vector<std::string>& given) {
  std::map<std::string, double> numbers;
  for (const std::string& text : given) {
    const auto equals = text.rfind('=');
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const std::string word = equals == std::string::npos ? text : text.substr(equals + 1);
    double value = 0.0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc() || end != word.data() + word.size() || !std::isfinite(value) ||
        value < 0.0 || equals == 0)
      throw Error(option + ": found \"" + text +
                  "\", expected VALUE or NAME=VALUE with a number of at least 0");
    if (!numbers.emplace(name, value).second)
      throw Error(option + ": found two values" + (name.empty() ? "" : " of " + name) +
                  ", expected one");
  }
  return numbers;
}

}  // namespace surge::compare
