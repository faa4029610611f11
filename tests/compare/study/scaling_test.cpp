#include "compare/study/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

TEST(FitPower, FindsAnExactLaw) {
  const auto fit =
      fit_power({{1, 3}, {10, 3 * std::pow(10.0, 1.7)}, {100, 3 * std::pow(100.0, 1.7)}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->exponent, 1.7, 1e-12);
  EXPECT_NEAR(fit->factor, 3.0, 1e-12);
  EXPECT_NEAR(fit->half_width, 0.0, 1e-6);
}

// log10 x = 0, 1, 2, 3 and log10 y = 0, 1, 1, 3: slope 0.9, residual sum 0.7, Sxx = 5, two degrees
// of freedom: 4.303 sqrt(0.7 / 2 / 5).
TEST(FitPower, IntervalByHand) {
  const auto fit = fit_power({{1, 1}, {10, 10}, {100, 10}, {1000, 1000}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->exponent, 0.9, 1e-12);
  EXPECT_NEAR(fit->half_width, 4.303 * std::sqrt(0.7 / 2 / 5), 1e-9);
}

TEST(FitPower, NeedsThreeDifferentPositivePoints) {
  EXPECT_FALSE(fit_power({{1, 1}, {2, 2}}));
  EXPECT_FALSE(fit_power({{2, 1}, {2, 2}, {2, 3}}));
  EXPECT_THROW(static_cast<void>(fit_power({{1, 1}, {2, 0}, {3, 3}})), surge::Error);
}

TEST(Median, OfOddAndEvenNumbers) {
  EXPECT_EQ(median_of({5, 1, 3}), 3.0);
  EXPECT_EQ(median_of({4, 1, 3, 2}), 2.5);
  EXPECT_THROW(static_cast<void>(median_of({})), surge::Error);
}

}  // namespace
}  // namespace surge::compare
