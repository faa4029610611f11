#include "particle/core/projection.hpp"

#include <gtest/gtest.h>

namespace surge {
namespace {

TEST(WithoutPartAlong, OnlyWhatIsNormalGoes) {
  using V = std::array<double, 2>;
  for (const double length : {3.0, -0.1}) {
    const V rest = without_part_along(V{3.0, 1.0}, V{0.6 * length, 0.8 * length});
    EXPECT_NEAR(rest[0], 3.0 - 2.6 * 0.6, 1e-15);
    EXPECT_NEAR(rest[1], 1.0 - 2.6 * 0.8, 1e-15);
  }
  EXPECT_EQ(without_part_along(V{3.0, 1.0}, V{}), (V{3.0, 1.0})) << "no direction to leave out";
}

}  // namespace
}  // namespace surge
