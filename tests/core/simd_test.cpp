#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "particle/core/simd.hpp"

namespace surge {
namespace {

// The pair loops take 1/r from it: from a particle with itself (1e-30) to padding far away (1e30).
TEST(InverseSqrt, IsExactToAFewUnitsInTheLastPlace) {
  for (double exponent = -30.0; exponent <= 30.0; exponent += 0.37) {
    alignas(64) std::array<double, simd_width> x;
    for (std::size_t k = 0; k < simd_width; ++k)
      x[k] = std::pow(10.0, exponent) * (1.0 + 0.9 * static_cast<double>(k));
    const Simd y = inverse_sqrt(load(x.data()));
    for (std::size_t k = 0; k < simd_width; ++k)
      EXPECT_NEAR(y[k] * std::sqrt(x[k]), 1.0, 1e-15) << x[k];
  }
}

}  // namespace
}  // namespace surge
