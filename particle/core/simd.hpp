#pragma once

#include <cstddef>
#include <experimental/simd>

namespace surge {

/// Makes a lambda part of the loop that calls it, so that what it reads and gives stays in
/// registers: the compiler takes those of the loops over pairs for too long.
#define SURGE_INLINE __attribute__((always_inline))

namespace stdx = std::experimental;

/// As many doubles as the processor works on at once.
using Simd = stdx::native_simd<double>;
inline constexpr std::size_t simd_width = Simd::size();

inline Simd load(const double* p) {
  return Simd(p, stdx::vector_aligned);
}

// GCC 12 takes its own placeholder for the lanes of a root for an uninitialised value (PR 105593).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
inline Simd root(Simd x) {
  return stdx::sqrt(x);
}
#pragma GCC diagnostic pop

/// to[k] = from[k] + shift for k < n. Runs of some ten numbers, of which the loops over cells copy
/// very many: whole vectors, the last one overlapping the one before instead of a rest by ones.
inline void copy_run(const double* from, std::size_t n, double shift, double* to) {
  if (n < simd_width) {
    for (std::size_t k = 0; k < n; ++k) to[k] = from[k] + shift;
    return;
  }
  const auto copy = [&](std::size_t k) {
    (Simd(from + k, stdx::element_aligned) + shift).copy_to(to + k, stdx::element_aligned);
  };
  for (std::size_t k = 0; k + simd_width <= n; k += simd_width) copy(k);
  copy(n - simd_width);
}

}  // namespace surge
