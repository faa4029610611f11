#include "particle/core/simd.hpp"

#include <gtest/gtest.h>

namespace surge {
namespace {

// Not a matter of course: a library for one compiler, used with another, left all lanes as they
// were.
TEST(SimdLanes, AreAssignedWhereAMaskIsSet) {
  const Simd lane([](auto i) { return static_cast<double>(i); });
  Simd x = lane + 1.0;
  stdx::where(lane == 0.0 || lane >= 2.0, x) = -5.0;
  for (std::size_t i = 0; i < simd_width; ++i)
    EXPECT_EQ(static_cast<double>(x[i]), i == 1 ? 2.0 : -5.0) << "lane " << i;
}

TEST(SimdLanes, OfARootThatIsMaskedAreSummed) {
  const Simd lane([](auto i) { return static_cast<double>(i); });
  Simd inverse = 1.0 / root(lane * lane);
  stdx::where(lane == 0.0, inverse) = 0.0;
  double sum = 0.0;
  for (std::size_t i = 1; i < simd_width; ++i) sum += 1.0 / static_cast<double>(i);
  EXPECT_NEAR(stdx::reduce(inverse), sum, 1e-14);
}

}  // namespace
}  // namespace surge
