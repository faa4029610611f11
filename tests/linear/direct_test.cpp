#include "particle/linear/direct.hpp"

#include <gtest/gtest.h>

#include "particle/support/error.hpp"
#include "tests/linear/poisson_fixture.hpp"

namespace surge::linear {
namespace {

using testing::largest_difference;
using testing::Lattice;
using testing::LatticeSystem;
using testing::noise;

TEST(SparseCholesky, AnalysesAGraphOnce) {
  PoissonSystem system = LatticeSystem(Lattice{}).system;
  SparseCholesky cholesky;
  for (int change = 0; change < 3; ++change) {
    for (double& value : system.diagonal) value += 1.0;
    const Field exact = noise(system.size());
    Field x;
    cholesky.factorise(system);
    cholesky.solve(testing::rhs_of(system, exact), x);
    EXPECT_LT(largest_difference(x, exact), 1e-10);
  }
  EXPECT_EQ(cholesky.analyses(), 1);
  cholesky.factorise(LatticeSystem(Lattice{.counts = {11, 12, 1}}).system);
  EXPECT_EQ(cholesky.analyses(), 2);
}

TEST(SparseCholesky, RefusesAnIndefiniteMatrix) {
  PoissonSystem system = LatticeSystem(Lattice{.counts = {8, 8, 1}}).system;
  system.diagonal[5] = -1.0;
  EXPECT_THROW(SparseCholesky().factorise(system), Error);
}

}  // namespace
}  // namespace surge::linear
