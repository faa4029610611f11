#pragma once

#include <cstddef>
#include <experimental/simd>

namespace surge {

namespace stdx = std::experimental;

/// As many doubles as the processor works on at once.
using Simd = stdx::native_simd<double>;
inline constexpr std::size_t simd_width = Simd::size();

inline Simd load(const double* p) {
  return Simd(p, stdx::vector_aligned);
}

}  // namespace surge
