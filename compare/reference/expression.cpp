#include "compare/reference/expression.hpp"

#include <charconv>
#include <cmath>

#include "particle/support/error.hpp"
#include "particle/support/spelling.hpp"
#include "particle/support/table.hpp"

namespace surge::compare {
namespace {

constexpr std::size_t deepest = 64;  ///< brackets in brackets

std::string quoted(const std::string& text) {
  std::string out = "\"";
  return out.append(text).append("\"");
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Recursive descent: sum = product {+- product}, product = power {*/ power}, power = atom [^
/// atom].
class Parser {
 public:
  Parser(const std::string& text, const Symbols& symbols, const std::string& place)
      : text_(text), symbols_(symbols), place_(place) {}

  SiValue all() {
    const SiValue found = sum();
    blanks();
    if (at_ < text_.size()) fail(quoted(text_.substr(at_)), "an operator or the end");
    if (!std::isfinite(found.value)) fail(quoted(text_), "a finite value");
    return found;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw Error(place_ + ": found " + found + ", expected " + expected);
  }
  void blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  SiValue sum() {
    SiValue left = product();
    while (true) {
      const bool plus = take('+');
      if (!plus && !take('-')) return left;
      const SiValue right = product();
      if (!left.same_dimension(right))
        fail("a sum of " + dimension_text(left) + " and " + dimension_text(right) + " in " +
                 quoted(text_),
             "one dimension");
      left.value += plus ? right.value : -right.value;
    }
  }

  SiValue product() {
    SiValue left = power();
    while (true) {
      const bool times = take('*');
      if (!times && !take('/')) return left;
      const SiValue right = power();
      left.value = times ? left.value * right.value : left.value / right.value;
      for (std::size_t k = 0; k < 3; ++k)
        left.powers[k] += times ? right.powers[k] : -right.powers[k];
    }
  }

  SiValue power() {
    if (take('-')) {
      SiValue found = power();
      found.value = -found.value;
      return found;
    }
    const SiValue base = atom();
    if (!take('^')) return base;
    const bool negative = take('-');
    SiValue exponent = atom();
    if (!exponent.same_dimension({})) fail("a power with a dimension", "a plain number");
    if (negative) exponent.value = -exponent.value;
    return raised(base, exponent.value);
  }

  static SiValue raised(SiValue base, double exponent) {
    base.value = std::pow(base.value, exponent);
    for (double& p : base.powers) p *= exponent;
    return base;
  }

  SiValue atom() {
    if (take('(')) return bracket();
    if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
    if (at_ < text_.size() && is_letter(text_[at_])) return named();
    fail(at_ < text_.size() ? quoted(text_.substr(at_)) : "the end of " + quoted(text_),
         "a number, a name or a bracket");
  }

  SiValue bracket() {
    if (++depth_ > deepest) fail("brackets in brackets", "fewer of them");
    const SiValue inside = sum();
    if (!take(')')) fail("no closing bracket in " + quoted(text_), "one");
    --depth_;
    return inside;
  }

  SiValue number() {
    double value = 0.0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc{}) fail(quoted(text_.substr(at_)), "a number");
    at_ += static_cast<std::size_t>(end - begin);
    return {value, {}};
  }

  SiValue named() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string name = text_.substr(begin, at_ - begin);
    if (name == "sqrt") {
      if (!take('(')) fail("sqrt without a bracket", "sqrt(...)");
      return raised(bracket(), 0.5);
    }
    const auto found = symbols_.find(name);
    if (found != symbols_.end()) return found->second;
    std::string known;
    for (const auto& [symbol, value] : symbols_) known += (known.empty() ? "" : " ") + symbol;
    fail(quoted(name), "one of " + known + " sqrt");
  }

  const std::string& text_;
  const Symbols& symbols_;
  const std::string& place_;
  std::size_t at_ = 0, depth_ = 0;
};

}  // namespace

bool SiValue::same_dimension(const SiValue& other) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(powers[k] - other.powers[k]) > 1e-9) return false;
  return true;
}

std::string dimension_text(const SiValue& quantity) {
  constexpr std::array names{"kg", "m", "s"};
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(quantity.powers[k]) < 1e-9) continue;
    if (!text.empty()) text += ' ';
    text += names[k];
    if (std::abs(quantity.powers[k] - 1.0) > 1e-9) text += plot_number(quantity.powers[k]);
  }
  return text.empty() ? "a plain number" : text;
}

const Symbols& unit_symbols() {
  static const Symbols units{
      {"m", {1.0, {0, 1, 0}}},     {"cm", {0.01, {0, 1, 0}}},  {"mm", {0.001, {0, 1, 0}}},
      {"s", {1.0, {0, 0, 1}}},     {"ms", {0.001, {0, 0, 1}}}, {"Pa", {1.0, {1, -1, -2}}},
      {"kPa", {1e3, {1, -1, -2}}}, {"N", {1.0, {1, 1, -2}}},   {"kN", {1e3, {1, 1, -2}}},
      {"J", {1.0, {1, 2, -2}}},    {"kg", {1.0, {1, 0, 0}}},   {"m2", {1.0, {0, 2, 0}}},
      {"m3", {1.0, {0, 3, 0}}}};
  return units;
}

Symbols case_symbols(const Physics& physics) {
  Symbols symbols = unit_symbols();
  const auto up = static_cast<std::size_t>(physics.vertical_axis());
  symbols["L"] = {physics.column_width().value(), {0, 1, 0}};
  const double height = physics.column.upper[up] - physics.column.lower[up];
  if (std::isfinite(height)) symbols["H"] = {height, {0, 1, 0}};
  symbols["d"] = {physics.bed_depth().value_or(Metres(0.0)).value(), {0, 1, 0}};
  symbols["g"] = {physics.gravity_magnitude(), {0, 1, -2}};
  if (physics.density) symbols["rho"] = {*physics.density, {1, -3, 0}};
  return symbols;
}

SiValue evaluate(const std::string& text, const Symbols& symbols, const std::string& place) {
  return Parser(text, symbols, place).all();
}

bool uses(const std::string& text, const std::string& name) {
  for (std::size_t at = 0; at < text.size();) {
    if (!is_letter(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    if (text.compare(at, end - at, name) == 0) return true;
    at = end;
  }
  return false;
}

double evaluate_in(const std::string& text, const std::string& unit, const Symbols& symbols,
                   const std::string& place) {
  const SiValue found = evaluate(text, symbols, place);
  const SiValue wanted = evaluate(unit, unit_symbols(), place);
  if (found.same_dimension({}) && text.find_first_not_of("0123456789.+-eE ") == std::string::npos)
    return found.value;
  if (!found.same_dimension(wanted))
    throw Error(place + ": found " + quoted(text) + " in " + dimension_text(found) + ", expected " +
                dimension_text(wanted));
  return found.value;
}

}  // namespace surge::compare
