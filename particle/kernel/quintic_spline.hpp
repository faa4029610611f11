#pragma once

#include <algorithm>
#include <numbers>

#include "particle/core/simd.hpp"

namespace surge {

/// Normalisation of the quintic spline in D dimensions, times h^D. The paper prints 120 for 1D and
/// 3/(359 pi) for 3D; these are the values for which the kernel integrates to one.
template <int D>
constexpr double quintic_spline_normalisation() {
  if constexpr (D == 1)
    return 1.0 / 120.0;
  else if constexpr (D == 2)
    return 7.0 / (478.0 * std::numbers::pi);
  else
    return 1.0 / (120.0 * std::numbers::pi);
}

// Eq. (18)
/// Quintic spline of Morris, Fox & Zhu (1997), J. Comput. Phys. 136, with R = r/h and support 3h:
///   W = a_D [ (3-R)^5 - 6 (2-R)^5 + 15 (1-R)^5 ],  each term only where its bracket is positive.
/// T is double or Simd.
template <int D>
class QuinticSpline {
 public:
  static constexpr double support = 3.0;  ///< in h

  /// h: smoothing length, m
  explicit QuinticSpline(double h)
      : inverse_h_(1.0 / h), value_(quintic_spline_normalisation<D>()) {
    for (int a = 0; a < D; ++a) value_ *= inverse_h_;
    slope_ = -5.0 * value_ * inverse_h_;
  }

  /// W(r), 1/m^D
  template <class T>
  [[nodiscard]] T value(T r) const {
    using std::max;
    const T q = r * T(inverse_h_);
    const T a = max(T(3.0) - q, T(0.0));
    const T b = max(T(2.0) - q, T(0.0));
    const T c = max(T(1.0) - q, T(0.0));
    return T(value_) * (fifth(a) - T(6.0) * fifth(b) + T(15.0) * fifth(c));
  }

  /// dW/dr, 1/m^(D+1); zero at r = 0
  template <class T>
  [[nodiscard]] T derivative(T r) const {
    using std::max;
    const T q = r * T(inverse_h_);
    const T a = max(T(3.0) - q, T(0.0));
    const T b = max(T(2.0) - q, T(0.0));
    const T c = max(T(1.0) - q, T(0.0));
    return T(slope_) * (fourth(a) - T(6.0) * fourth(b) + T(15.0) * fourth(c));
  }

  /// (dW/dr) / r, 1/m^(D+2), r > 0: grad W = slope x
  template <class T>
  [[nodiscard]] T slope(T r) const {
    return derivative(r) / r;
  }

 private:
  template <class T>
  static T fourth(T a) {
    const T square = a * a;
    return square * square;
  }
  template <class T>
  static T fifth(T a) {
    return fourth(a) * a;
  }

  double inverse_h_;
  double value_;
  double slope_ = 0.0;
};

}  // namespace surge
