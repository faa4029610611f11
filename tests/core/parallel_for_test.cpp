#include "particle/core/parallel_for.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "particle/core/extremes.hpp"
#include "tests/core/threads.hpp"

namespace surge {
namespace {

/// How often a loop calls its body with each index below n, whatever their number and the threads'.
template <class Loop>
void expect_each_once(const Loop& loop) {
  for (const int threads : {1, 3})
    for (const std::ptrdiff_t n : {0, 1, 7, 200}) {
      const Threads set(threads);
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(n));
      loop(n, [&](std::ptrdiff_t i) { ++calls[static_cast<std::size_t>(i)]; });
      for (const auto& count : calls) EXPECT_EQ(count, 1) << n << " on " << threads;
    }
}

TEST(ParallelFor, VisitsEachIndexOnce) {
  for (const std::ptrdiff_t from : {1, 100, 1000})
    expect_each_once([&](std::ptrdiff_t n, const auto& f) { parallel_for(n, from, f); });
  expect_each_once([](std::ptrdiff_t n, const auto& f) { parallel_for_in_stretches(n, 16, f); });
  expect_each_once([](std::ptrdiff_t n, const auto& f) {
    parallel_for_in_turn(n, 3, [&](std::ptrdiff_t i, std::size_t thread) {
      EXPECT_LT(thread, static_cast<std::size_t>(omp_get_max_threads()));
      f(i);
    });
  });
}

TEST(ParallelFor, IsSharedFromThatManyIterationsOn) {
  const auto helpers = [](std::ptrdiff_t n, std::ptrdiff_t from) {
    std::atomic<int> others = 0;
    parallel_for(n, from, [&](std::ptrdiff_t) { others += omp_get_thread_num() > 0 ? 1 : 0; });
    return others.load();
  };
  const Threads two(2);
  EXPECT_EQ(helpers(99, 100), 0);
  EXPECT_EQ(helpers(100, 100), 50);
  const Threads one(1);
  EXPECT_EQ(helpers(100, 100), 0);
}

// A thread of somebody else's team has a number that the loop's own arrays do not reach to.
TEST(ParallelFor, InsideATeamEachThreadIsTheFirstOfItsOwn) {
  std::atomic<int> wrong = 0;
#pragma omp parallel num_threads(4)
  parallel_for_in_turn(std::ptrdiff_t{10}, 100,
                       [&](std::ptrdiff_t, std::size_t thread) { wrong += thread == 0 ? 0 : 1; });
  EXPECT_EQ(wrong, 0);
}

TEST(ParallelReduce, DoesNotDependOnTheThreads) {
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i * i));
  const double largest = *std::max_element(values.begin(), values.end());
  for (const int threads : {1, 2, 5}) {
    const Threads set(threads);
    const auto look = [&](std::ptrdiff_t i, double& most) {
      most = std::max(most, values[static_cast<std::size_t>(i)]);
    };
    EXPECT_EQ(parallel_reduce(std::ptrdiff_t{1000}, 10, -2.0, look, larger), largest);
    EXPECT_EQ(parallel_reduce(std::ptrdiff_t{0}, 10, -2.0, look, larger), -2.0);
    const auto count = [](std::int32_t i, long& odd) { odd += i % 2; };
    const auto add = [](long& all, long own) { all += own; };
    EXPECT_EQ(parallel_reduce(std::int32_t{1001}, 10, 0L, count, add), 500);
  }
}

TEST(Extremes, OfNumbers) {
  std::vector<double> values(9000);
  std::iota(values.begin(), values.end(), -17.0);
  const auto value = [&](std::ptrdiff_t i) { return values[static_cast<std::size_t>(i)]; };
  for (const int threads : {1, 3}) {
    const Threads set(threads);
    values[1234] = 0.0;
    const Extremes found = extremes_of(std::ptrdiff_t{9000}, value);
    EXPECT_EQ(found.low, -17.0);
    EXPECT_EQ(found.high, 8982.0);
    EXPECT_TRUE(found.finite);
    for (const double odd :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()}) {
      values[1234] = odd;
      EXPECT_FALSE(extremes_of(std::ptrdiff_t{9000}, value).finite) << odd;
    }
  }
  const Extremes none = extremes_of(std::ptrdiff_t{0}, value);
  EXPECT_GT(none.low, none.high);
  EXPECT_TRUE(none.finite);
}

}  // namespace
}  // namespace surge
