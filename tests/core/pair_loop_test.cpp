#include "particle/core/pair_loop.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace surge {
namespace {

TEST(Runs, AreCopiedToTheLastNumber) {
  for (std::size_t n = 0; n <= 3 * simd_width; ++n) {
    std::vector<double> from(n + 2);
    for (std::size_t k = 0; k < from.size(); ++k) from[k] = static_cast<double>(k * k);
    std::vector<double> to(n + 2, -1.0);
    copy_run(from.data() + 1, n, 0.5, to.data() + 1);
    EXPECT_EQ(to.front(), -1.0);
    EXPECT_EQ(to.back(), -1.0);
    for (std::size_t k = 1; k <= n; ++k) EXPECT_EQ(to[k], from[k] + 0.5) << n;
  }
}

}  // namespace
}  // namespace surge
