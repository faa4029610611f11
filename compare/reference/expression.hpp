#pragma once

#include <array>
#include <map>
#include <string>

#include "compare/read/physics.hpp"

namespace surge::compare {

/// A number in SI units with its dimension: powers of kg, m, s.
struct SiValue {
  double value = 0.0;
  std::array<double, 3> powers{};

  [[nodiscard]] bool same_dimension(const SiValue& other) const;
};

/// "m", "kg m-1 s-2", "1": what a dimension is in SI units.
[[nodiscard]] std::string dimension_text(const SiValue& quantity);

/// What names in an expression stand for.
using Symbols = std::map<std::string, SiValue>;

/// Units: m cm mm s ms Pa kPa N kN J kg m2 m3; and the number 1.
[[nodiscard]] const Symbols& unit_symbols();

/// L, H (width and height of the column, or of the block that stands for it), d (depth of the bed,
/// 0 where there is none), g and, where it is stated, rho; with all units.
[[nodiscard]] Symbols case_symbols(const Physics& physics);

/// The value of an expression of numbers, names, + - * / ^ ( ) and sqrt(); ^ takes a number.
/// Throws surge::Error, beginning with `place`, for what is no expression, an unknown name, sums of
/// different dimensions, and values that are not finite.
[[nodiscard]] SiValue evaluate(const std::string& text, const Symbols& symbols,
                               const std::string& place);

/// Names in an expression, functions left out.
[[nodiscard]] bool uses(const std::string& text, const std::string& name);

/// The same in the dimension of `unit` ("m", "Pa", "J/m", "1", as an observable states it). A plain
/// number stands for one in SI units. Throws surge::Error for another dimension.
[[nodiscard]] double evaluate_in(const std::string& text, const std::string& unit,
                                 const Symbols& symbols, const std::string& place);

}  // namespace surge::compare
