#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace surge {

/// The interval that a number must lie in; non-finite numbers never do.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_excluded = false;
  bool upper_excluded = false;

  [[nodiscard]] bool contain(double value) const;
  /// "above 0", "between 0 and 1, both excluded"; empty where any number will do.
  [[nodiscard]] std::string text() const;

  static constexpr Bounds above(double limit) { return {.lower = limit, .lower_excluded = true}; }
  static constexpr Bounds at_least(double limit) { return {.lower = limit}; }
  static constexpr Bounds closed(double from, double to) { return {.lower = from, .upper = to}; }
  static constexpr Bounds open(double from, double to) { return {from, to, true, true}; }
  static constexpr Bounds above_to(double from, double to) { return {from, to, true, false}; }
};

/// One enumerator and what it is called in files.
template <class E>
struct Named {
  std::string_view name;
  E value;
};
template <class E>
Named(const char*, E) -> Named<E>;

/// The shortest text that reads back as the same number.
[[nodiscard]] std::string number_text(double value);

}  // namespace surge
