#pragma once

#include <cmath>
#include <compare>

namespace surge::compare {

/// A number with one meaning. Two of different kinds neither compare nor add, and a plain double
/// becomes one only where its kind is written out, so that a wrong normalisation does not compile.
template <class Kind>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr explicit Quantity(double value) : value_(value) {}

  [[nodiscard]] constexpr double value() const { return value_; }
  [[nodiscard]] bool is_finite() const { return std::isfinite(value_); }

  // clang-tidy 14 sees a null pointer in what the compiler makes of it.
  constexpr auto operator<=>(const Quantity&) const = default;  // NOLINT(modernize-use-nullptr)
  constexpr Quantity operator-() const { return Quantity(-value_); }
  constexpr Quantity& operator+=(Quantity b) {
    value_ += b.value_;
    return *this;
  }
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity(a.value_ + b.value_);
  }
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity(a.value_ - b.value_);
  }
  friend constexpr Quantity operator*(double factor, Quantity a) {
    return Quantity(factor * a.value_);
  }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value_ / b.value_; }

 private:
  double value_ = 0.0;
};

using Seconds = Quantity<struct SecondsKind>;
using Metres = Quantity<struct MetresKind>;
using DimensionlessTime = Quantity<struct DimensionlessTimeKind>;      ///< T = t sqrt(2g/L)
using DimensionlessLength = Quantity<struct DimensionlessLengthKind>;  ///< Z/L

/// The scales of a collapsing column and the only way between the two kinds of units:
/// T = t sqrt(2g/L) and Z/L = x/L (Martin & Moyce 1952, n^2 = 2), L the width of the column.
class Scales {
 public:
  /// column_width: L > 0. gravity: magnitude g > 0 in m/s2. Throws surge::Error otherwise.
  Scales(Metres column_width, double gravity);

  [[nodiscard]] Metres column_width() const { return column_width_; }
  [[nodiscard]] double gravity() const { return gravity_; }

  [[nodiscard]] DimensionlessTime dimensionless(Seconds t) const {
    return DimensionlessTime(t.value() * rate_);
  }
  [[nodiscard]] DimensionlessLength dimensionless(Metres x) const {
    return DimensionlessLength(x / column_width_);
  }
  [[nodiscard]] Seconds dimensional(DimensionlessTime t) const {
    return Seconds(t.value() / rate_);
  }
  [[nodiscard]] Metres dimensional(DimensionlessLength z) const {
    return z.value() * column_width_;
  }

 private:
  Metres column_width_;
  double gravity_;
  double rate_;  ///< sqrt(2g/L), 1/s
};

}  // namespace surge::compare
