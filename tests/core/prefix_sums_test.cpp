#include "particle/core/prefix_sums.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace surge {
namespace {

TEST(PrefixSums, AreTheSameWithAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  for (const std::size_t n : {0u, 1u, 7u, 16384u, 50001u}) {
    std::vector<std::uint32_t> serial(n + 1);
    for (std::size_t k = 0; k < n; ++k)
      serial[k + 1] = serial[k] + static_cast<std::uint32_t>(k * k % 7);
    for (const int threads : {1, 2, 3, 8}) {
      omp_set_num_threads(threads);
      std::vector<std::uint32_t> out(n + 1, 99u);
      PrefixSums sums;
      EXPECT_EQ(sums(
                    n, [](std::size_t k) { return k * k % 7; }, out.data()),
                serial[n]);
      EXPECT_EQ(out, serial) << n << " by " << threads;
    }
  }
  omp_set_num_threads(before);
}

TEST(PrefixSums, TakeWhatStandsInTheirPlace) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(4);
  std::vector<int> out(40001, 3);
  PrefixSums sums;
  EXPECT_EQ(sums(
                40000, [&](std::size_t k) { return out[k + 1]; }, out.data()),
            120000);
  for (std::size_t k = 0; k <= 40000; ++k) ASSERT_EQ(out[k], 3 * static_cast<int>(k));
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace surge
