#include "compare/read/units.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

template <class A, class B>
concept Comparable = requires(A a, B b) {
  a < b;
};
template <class A, class B>
concept Addable = requires(A a, B b) {
  a + b;
};

static_assert(Comparable<Seconds, Seconds> && Addable<Metres, Metres>);
static_assert(!Comparable<Seconds, DimensionlessTime>, "a time is not a T");
static_assert(!Addable<Metres, DimensionlessLength>, "a length is not a Z/L");
static_assert(!std::is_convertible_v<double, Seconds> && !std::is_convertible_v<Seconds, double>);
static_assert(!std::is_convertible_v<Seconds, DimensionlessTime>);
static_assert(
    !std::is_invocable_v<decltype([](auto t) -> decltype(std::declval<Scales>().dimensionless(t)) {
                           return std::declval<Scales>().dimensionless(t);
                         }),
                         DimensionlessTime>,
    "T is not made dimensionless twice");

TEST(Scales, MakeTheDamBreakDimensionless) {
  const Scales scales(Metres(0.145), 9.81);
  // sqrt(2 * 9.81 / 0.145) = 11.632298 1/s
  EXPECT_NEAR(scales.dimensionless(Seconds(0.2)).value(), 2.3264596, 1e-6);
  EXPECT_DOUBLE_EQ(scales.dimensionless(Metres(0.58)).value(), 4.0);
  EXPECT_DOUBLE_EQ(scales.dimensional(scales.dimensionless(Seconds(0.2))).value(), 0.2);
  EXPECT_DOUBLE_EQ(scales.dimensional(scales.dimensionless(Metres(0.3))).value(), 0.3);
}

TEST(Scales, RefuseImpossibleColumnsAndGravity) {
  EXPECT_THROW(Scales(Metres(0.0), 9.81), Error);
  EXPECT_THROW(Scales(Metres(-1.0), 9.81), Error);
  EXPECT_THROW(Scales(Metres(0.145), 0.0), Error);
  EXPECT_THROW(Scales(Metres(std::numeric_limits<double>::quiet_NaN()), 9.81), Error);
}

}  // namespace
}  // namespace surge::compare
