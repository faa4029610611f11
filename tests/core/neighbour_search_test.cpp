#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <random>

#include "particle/core/neighbour_list.hpp"
#include "particle/support/error.hpp"

namespace surge {
namespace {

template <int D>
std::array<Field, D> random_positions(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::array<Field, D> x;
  for (int a = 0; a < D; ++a)
    for (std::size_t i = 0; i < n; ++i) x[a].push_back(unit(random));
  return x;
}

template <int D>
Periodicity<D> unit_period_in_x(bool on) {
  Periodicity<D> p;
  if (on) p.length[0] = 1.0;
  return p;
}

/// Neighbour lists as sets of pairs of the original numbers, each sorted.
template <int D>
std::vector<std::vector<std::uint32_t>> lists(Search search, std::array<Field, D> x, double radius,
                                              int reach, bool periodic) {
  const std::size_t n = x[0].size();
  AlignedVector<std::int32_t> id(n);
  std::iota(id.begin(), id.end(), 0);
  CellGrid<D> grid(search, unit_period_in_x<D>(periodic));
  grid.build(x, radius, reach);
  for (int a = 0; a < D; ++a) grid.reorder(x[a]);
  grid.reorder(id);
  NeighbourList<D> list;
  list.build(grid, x, radius, [](std::size_t) { return true; });
  std::vector<std::vector<std::uint32_t>> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    auto& out = result[static_cast<std::size_t>(id[i])];
    for (const std::uint32_t j : list.of(i)) out.push_back(static_cast<std::uint32_t>(id[j]));
    std::sort(out.begin(), out.end());
  }
  return result;
}

struct Setup {
  int reach;
  bool periodic;
  double radius;
};

class Searches : public testing::TestWithParam<Setup> {};

template <int D>
void expect_same_lists(const Setup& s, std::size_t n) {
  const auto x = random_positions<D>(n, 7);
  const auto pairs = lists<D>(Search::all_pairs, x, s.radius, s.reach, s.periodic);
  EXPECT_EQ(pairs, (lists<D>(Search::cell_grid, x, s.radius, s.reach, s.periodic)));
  // And against the definition.
  for (std::size_t i = 0; i < n; i += 17) {
    std::vector<std::uint32_t> expected;
    for (std::size_t j = 0; j < n; ++j) {
      double r2 = 0.0;
      for (int a = 0; a < D; ++a) {
        double d = x[a][j] - x[a][i];
        if (s.periodic && a == 0) d -= std::nearbyint(d);
        r2 += d * d;
      }
      if (j != i && r2 < s.radius * s.radius) expected.push_back(static_cast<std::uint32_t>(j));
    }
    ASSERT_EQ(pairs[i], expected) << "particle " << i;
  }
}

TEST_P(Searches, FindTheSamePairs2D) {
  expect_same_lists<2>(GetParam(), 800);
}
TEST_P(Searches, FindTheSamePairs3D) {
  expect_same_lists<3>(GetParam(), 700);
}

INSTANTIATE_TEST_SUITE_P(Setups, Searches,
                         testing::Values(Setup{1, false, 0.1}, Setup{2, false, 0.1},
                                         Setup{2, false, 0.031}, Setup{3, false, 0.2},
                                         Setup{1, true, 0.1}, Setup{2, true, 0.13},
                                         Setup{2, true, 0.3}, Setup{2, false, 2.0}));

TEST(CellGrid, OrderDoesNotDependOnTheNumberOfThreads) {
  const auto start = random_positions<2>(5000, 3);
  std::vector<double> reference;
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    auto x = start;
    CellGrid<2> grid(Search::cell_grid, {});
    grid.build(x, 0.05, 2);
    for (int a = 0; a < 2; ++a) grid.reorder(x[a]);
    std::vector<double> order(x[0].begin(), x[0].end());
    if (reference.empty()) reference = order;
    EXPECT_EQ(order, reference) << threads << " threads";
  }
  omp_set_num_threads(before);
}

TEST(CellGrid, ParticlesFarAwayDoNotExhaustMemory) {
  auto x = random_positions<2>(100, 5);
  x[0][3] = 1e9;
  x[1][4] = -1e9;
  CellGrid<2> grid(Search::cell_grid, {});
  grid.build(x, 0.01, 2);
  EXPECT_LE(grid.cell_count(), 5000u);
}

TEST(CellGrid, NonFinitePositionIsAnError) {
  auto x = random_positions<2>(100, 5);
  x[1][50] = std::numeric_limits<double>::quiet_NaN();
  CellGrid<2> grid(Search::cell_grid, {});
  EXPECT_THROW(grid.build(x, 0.1, 1), Error);
}

}  // namespace
}  // namespace surge
