#pragma once

#include <algorithm>
#include <numbers>

#include "particle/core/simd.hpp"

namespace surge {

/// Wendland's C2 function (Wendland 1995, Adv. Comput. Math. 4) with R = r/h and support 2h:
///   1D: W = 5/(8h) (1 - R/2)^3 (1 + 3R/2);  2D, 3D: W = a_D (1 - R/2)^4 (1 + 2R),
///   a_2 = 7/(4 pi h^2), a_3 = 21/(16 pi h^3).
/// T is double or Simd.
template <int D>
class WendlandC2 {
 public:
  static constexpr double support = 2.0;  ///< in h

  /// h: smoothing length, m
  explicit WendlandC2(double h) : inverse_h_(1.0 / h), value_(normalisation()) {
    for (int a = 0; a < D; ++a) value_ *= inverse_h_;
    slope_ = (D == 1 ? -3.0 : -5.0) * value_ * inverse_h_;
  }

  /// W(r), 1/m^D
  template <class T>
  [[nodiscard]] T value(T r) const {
    using std::max;
    const T q = r * T(inverse_h_);
    const T a = max(T(1.0) - T(0.5) * q, T(0.0));
    if constexpr (D == 1)
      return T(value_) * a * a * a * (T(1.0) + T(1.5) * q);
    else
      return T(value_) * a * a * a * a * (T(1.0) + T(2.0) * q);
  }

  /// dW/dr, 1/m^(D+1): -5 a_D R (1 - R/2)^3 / h in 2D and 3D, -3 a_1 R (1 - R/2)^2 / h in 1D
  template <class T>
  [[nodiscard]] T derivative(T r) const {
    using std::max;
    const T q = r * T(inverse_h_);
    const T a = max(T(1.0) - T(0.5) * q, T(0.0));
    if constexpr (D == 1)
      return T(slope_) * q * a * a;
    else
      return T(slope_) * q * a * a * a;
  }

  /// (dW/dr) / r, 1/m^(D+2): grad W = slope x. Nothing is divided by r, which cancels.
  template <class T>
  [[nodiscard]] T slope(T r) const {
    using std::max;
    const T a = max(T(1.0) - T(0.5 * inverse_h_) * r, T(0.0));
    if constexpr (D == 1)
      return T(slope_ * inverse_h_) * a * a;
    else
      return T(slope_ * inverse_h_) * a * a * a;
  }

 private:
  static constexpr double normalisation() {
    if constexpr (D == 1)
      return 5.0 / 8.0;
    else if constexpr (D == 2)
      return 7.0 / (4.0 * std::numbers::pi);
    else
      return 21.0 / (16.0 * std::numbers::pi);
  }

  double inverse_h_;
  double value_;
  double slope_ = 0.0;
};

}  // namespace surge
