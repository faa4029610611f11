#include <gtest/gtest.h>

#include <cmath>

#include "particle/core/smallest_eigenvalue.hpp"

namespace surge {
namespace {

TEST(SmallestEigenvalue, OfDiagonalMatrices) {
  EXPECT_DOUBLE_EQ(smallest_eigenvalue<2>({0.7, 0.0, 0.2}), 0.2);
  EXPECT_NEAR(smallest_eigenvalue<3>({0.7, 0.0, 0.0, 0.1, 0.0, 0.4}), 0.1, 1e-12);
}

// a (1 1; 1 1)/2 + b (1 -1; -1 1)/2 has the eigenvalues a and b.
TEST(SmallestEigenvalue, OfTurnedMatrices) {
  EXPECT_NEAR(smallest_eigenvalue<2>({0.6, 0.4, 0.6}), 0.2, 1e-15);
  EXPECT_NEAR(smallest_eigenvalue<3>({0.6, 0.0, 0.4, 0.5, 0.0, 0.6}), 0.2, 1e-12);
  EXPECT_NEAR(smallest_eigenvalue<3>({0.6, 0.0, 0.4, 0.1, 0.0, 0.6}), 0.1, 1e-12);
}

TEST(SmallestEigenvalue, OfNothingIsZero) {
  EXPECT_EQ(smallest_eigenvalue<2>({}), 0.0);
  EXPECT_EQ(smallest_eigenvalue<3>({}), 0.0);
}

}  // namespace
}  // namespace surge
