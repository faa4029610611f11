#include "particle/core/balanced_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "tests/core/threads.hpp"

namespace surge {
namespace {

TEST(BalancedLoop, DoesEveryIndexOnce) {
  BalancedLoop loop;
  for (const int threads : {1, 2, 3, 7, 2}) {
    const Threads set(threads);
    for (const std::size_t size : {0U, 1U, 255U, 256U, 257U, 1024U, 10001U}) {
      std::vector<int> done(size, 0);
      loop.each(size, [&](std::size_t i) { ++done[i]; });
      EXPECT_EQ(std::count(done.begin(), done.end(), 1), static_cast<std::ptrdiff_t>(size))
          << threads << " threads, " << size;
    }
  }
}

TEST(BalancedLoop, BlocksBeginAtMultiplesAndTheLastIsTheRest) {
  const Threads set(2);
  BalancedLoop loop;
  std::vector<std::size_t> length(11, 0);
  loop.blocks(105, 10, [&](std::size_t begin, std::size_t end) {
    EXPECT_EQ(begin % 10, 0U);
    length[begin / 10] = end - begin;
  });
  for (std::size_t b = 0; b < 10; ++b) EXPECT_EQ(length[b], 10U);
  EXPECT_EQ(length[10], 5U);
}

TEST(BalancedLoop, AThreadThatIsHeldUpLosesItsWorkToTheOther) {
  const Threads set(2);
  BalancedLoop loop;
  std::vector<int> by(100, -1);
  loop.blocks(100, 1, [&](std::size_t begin, std::size_t) {
    const int thread = omp_get_thread_num();
    by[begin] = thread;
    if (thread == 1) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  });
  // Halves would be fifty each; the one that sleeps has done a few at most.
  EXPECT_LT(std::count(by.begin(), by.end(), 1), 40);
  EXPECT_EQ(std::count(by.begin(), by.end(), -1), 0);
}

}  // namespace
}  // namespace surge
