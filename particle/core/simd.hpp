#pragma once

#include <cstddef>
#include <experimental/simd>

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace surge {

namespace stdx = std::experimental;

/// As many doubles as the processor works on at once.
using Simd = stdx::native_simd<double>;
inline constexpr std::size_t simd_width = Simd::size();

inline Simd load(const double* p) {
  return Simd(p, stdx::vector_aligned);
}

/// 1/sqrt(x) for x > 0, to a few units in the last place.
///
/// Root and division take most of the time of a pair loop. Where the processor estimates the
/// inverse root to 14 bits, two Newton steps y (3 - x y^2) / 2 bring it to double precision in a
/// third of the time.
inline Simd inverse_sqrt(Simd x) {
#if defined(__AVX512F__)
  if constexpr (simd_width == 8) {
    const Simd half = Simd(0.5) * x;
    // The masked form, because GCC 12 warns about its own header with the plain one.
    Simd y = Simd(_mm512_maskz_rsqrt14_pd(0xff, static_cast<__m512d>(x)));
    y *= Simd(1.5) - half * y * y;
    y *= Simd(1.5) - half * y * y;
    return y;
  }
#endif
  return Simd(1.0) / stdx::sqrt(x);
}

}  // namespace surge
