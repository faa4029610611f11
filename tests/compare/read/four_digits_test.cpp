#include "compare/read/four_digits.hpp"

#include <gtest/gtest.h>

namespace surge::compare {
namespace {

TEST(FourDigits, NoMoreThanAreNeeded) {
  EXPECT_EQ(four_digits(3 * 0.0145), "0.0435");
  EXPECT_EQ(four_digits(1.0 / 3.0), "0.3333");
  EXPECT_EQ(four_digits(2.0), "2");
  EXPECT_EQ(four_digits(-12345.6), "-12350");
  EXPECT_EQ(four_digits(0.0), "0");
}

}  // namespace
}  // namespace surge::compare
