#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "particle/support/bounds.hpp"

namespace surge::compare {

/// What an observable is asked for with, as text: "gauge:x=0.3,z=0.1" or a table of a study. Each
/// key is taken once; finish() refuses what nothing has taken.
class Parameters {
 public:
  Parameters() = default;
  /// `source`: what errors begin with.
  Parameters(std::map<std::string, std::string> entries, std::string source)
      : entries_(std::move(entries)), source_(std::move(source)) {}

  /// Throws surge::Error for text that is no number or outside of the bounds.
  [[nodiscard]] std::optional<double> number(const std::string& key, const Bounds& bounds = {});
  /// Throws surge::Error where there is none.
  [[nodiscard]] double required(const std::string& key, const Bounds& bounds = {});
  [[nodiscard]] std::optional<std::string> text(const std::string& key);
  /// Numbers separated by `;` or blanks.
  [[nodiscard]] std::vector<double> numbers(const std::string& key);
  /// Throws surge::Error for a key that nothing has taken, with the nearest that is known.
  void finish() const;

  [[noreturn]] void fail(const std::string& key, const std::string& found,
                         const std::string& expected) const;

 private:
  [[nodiscard]] double parse(const std::string& key, const std::string& text,
                             const Bounds& bounds) const;

  std::map<std::string, std::string> entries_;
  std::string source_;
  std::set<std::string> taken_;
};

}  // namespace surge::compare
