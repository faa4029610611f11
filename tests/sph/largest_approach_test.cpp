#include "particle/sph/largest_approach.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace surge::sph {
namespace {

using Places = std::array<Field, 2>;

TEST(LargestApproach, OfParticlesThatMoveTogetherIsZero) {
  const Places then{Field{0.0, 1.0, 5.0}, Field{2.0, 3.0, -1.0}};
  const Places now{Field{0.5, 1.5, 5.5}, Field{1.0, 2.0, -2.0}};
  EXPECT_EQ(largest_approach<2>(then, then), 0.0);
  EXPECT_EQ(largest_approach<2>(now, then), 0.0);
}

// 3 long along x and 5 along y.
TEST(LargestApproach, IsTheBoxThatHoldsAllDisplacements) {
  const Places then{Field{0.0, 0.0, 0.0}, Field{0.0, 0.0, 0.0}};
  const Places now{Field{-1.0, 2.0, 0.0}, Field{0.0, 5.0, 1.0}};
  EXPECT_DOUBLE_EQ(largest_approach<2>(now, then), std::hypot(3.0, 5.0));
  const std::array<Field, 3> at{Field{0.0, 0.0}, Field{0.0, 0.0}, Field{0.0, 0.0}};
  const std::array<Field, 3> moved{Field{0.0, 1.0}, Field{0.0, 2.0}, Field{2.0, 0.0}};
  EXPECT_DOUBLE_EQ(largest_approach<3>(moved, at), 3.0);
}

// Two that meet head-on come nearer by exactly the bound.
TEST(LargestApproach, IsReachedHeadOn) {
  const Places then{Field{0.0, 1.0}, Field{0.0, 0.0}};
  const Places now{Field{0.2, 0.9}, Field{0.0, 0.0}};
  const double nearer = 1.0 - (0.9 - 0.2);
  EXPECT_DOUBLE_EQ(largest_approach<2>(now, then), nearer);
}

TEST(LargestApproach, OfWhatIsNotFiniteIsInfinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Places then{Field{0.0, 1.0}, Field{0.0, 1.0}};
  for (const double odd : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(largest_approach<2>({Field{0.0, 1.0}, Field{0.0, odd}}, then), infinity);
}

}  // namespace
}  // namespace surge::sph
