#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "particle/core/symmetric_pair_loop.hpp"

namespace surge {
namespace {

struct Setup {
  Search search;
  int reach;
  bool periodic;
  std::size_t particles;
  double radius = 0.11;
};

template <int D>
std::array<Field, D + 1> random_cloud(std::size_t n) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::array<Field, D + 1> fields;  // position and a charge
  for (auto& field : fields)
    for (std::size_t i = 0; i < n; ++i) field.push_back(unit(random));
  return fields;
}

template <int D>
Periodicity<D> unit_period(bool on) {
  Periodicity<D> p;
  if (on) p.length.fill(1.0);
  return p;
}

/// A term that is the same for both particles of a pair, one that is opposite, and one that is
/// neither, so that a pair missed, met twice or credited to the wrong one shows.
template <int D>
PairTerms<3> terms(const std::array<Simd, D + 1>& i, const std::array<Simd, D + 1>& j,
                   double radius) {
  Simd r2 = 0.0;
  for (int a = 0; a < D; ++a) r2 += (j[a] - i[a]) * (j[a] - i[a]);
  Simd weight = stdx::max(Simd(radius * radius) - r2, Simd(0.0));
  stdx::where(r2 == 0.0, weight) = 0.0;
  PairTerms<3> out;
  out.to_i = {weight, weight * (j[0] - i[0]), weight * j[D]};
  out.to_j = {weight, weight * (i[0] - j[0]), weight * i[D]};
  return out;
}

/// Fields and sums in the order of the grid.
template <int D>
struct Result {
  std::array<Field, D + 1> fields;
  std::array<Field, 3> sums;
};

template <int D>
Result<D> add_up(const Setup& s) {
  Result<D> r{random_cloud<D>(s.particles), {}};
  std::array<Field, D> x;
  std::copy_n(r.fields.begin(), D, x.begin());
  CellGrid<D> grid(s.search, unit_period<D>(s.periodic));
  grid.build(x, s.radius, s.reach);
  for (auto& field : r.fields) grid.reorder(field);
  typename SymmetricPairLoop<D, D + 1, 3>::Sources in;
  typename SymmetricPairLoop<D, D + 1, 3>::Sums out;
  for (int k = 0; k <= D; ++k) in[k] = r.fields[k].data();
  for (int k = 0; k < 3; ++k) {
    r.sums[k].assign(s.particles, 99.0);  // must be overwritten
    out[k] = r.sums[k].data();
  }
  SymmetricPairLoop<D, D + 1, 3> loop;
  loop(
      grid, in, out, [](std::size_t) { return true; },
      [](std::size_t, std::size_t) { return true; },
      [&](const auto& i, const auto& j) { return terms<D>(i, j, s.radius); });
  return r;
}

template <int D>
void expect_the_definition(const Setup& s) {
  const Result<D> r = add_up<D>(s);
  const std::size_t stride = s.particles < 10000 ? 7 : 97;
  for (std::size_t i = 0; i < s.particles; i += stride) {
    std::array<double, 3> expected{};
    for (std::size_t j = 0; j < s.particles; ++j) {
      std::array<double, D> dx;
      double r2 = 0.0;
      for (int a = 0; a < D; ++a) {
        dx[a] = r.fields[a][j] - r.fields[a][i];
        if (s.periodic) dx[a] -= std::nearbyint(dx[a]);
        r2 += dx[a] * dx[a];
      }
      if (i == j || r2 >= s.radius * s.radius) continue;
      const double weight = s.radius * s.radius - r2;
      expected[0] += weight;
      expected[1] += weight * dx[0];
      expected[2] += weight * r.fields[D][j];
    }
    for (int k = 0; k < 3; ++k)
      ASSERT_NEAR(r.sums[k][i], expected[k], 1e-13) << "sum " << k << " of particle " << i;
  }
}

class SymmetricPairs : public testing::TestWithParam<Setup> {};

TEST_P(SymmetricPairs, AreEachMetOnce2D) {
  expect_the_definition<2>(GetParam());
}
TEST_P(SymmetricPairs, AreEachMetOnce3D) {
  expect_the_definition<3>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Setups, SymmetricPairs,
                         testing::Values(Setup{Search::cell_grid, 1, false, 900},
                                         Setup{Search::cell_grid, 2, false, 900},
                                         Setup{Search::cell_grid, 3, false, 2500},
                                         Setup{Search::cell_grid, 2, true, 900},
                                         Setup{Search::cell_grid, 1, true, 2500},
                                         Setup{Search::cell_grid, 2, true, 5},
                                         Setup{Search::all_pairs, 1, false, 900},
                                         Setup{Search::all_pairs, 1, true, 500}));

// So many cells that the blocks are larger than the smallest ones.
INSTANTIATE_TEST_SUITE_P(LargeBlocks, SymmetricPairs,
                         testing::Values(Setup{Search::cell_grid, 2, false, 40000, 0.008},
                                         Setup{Search::cell_grid, 1, true, 40000, 0.018}));

TEST(SymmetricPairs, SumsAreTheSameWhateverTheNumberOfThreads) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Result<2> one = add_up<2>({Search::cell_grid, 2, true, 20000});
  for (const int threads : {2, 3, 7}) {
    omp_set_num_threads(threads);
    const Result<2> many = add_up<2>({Search::cell_grid, 2, true, 20000});
    for (int k = 0; k < 3; ++k) EXPECT_EQ(one.sums[k], many.sums[k]) << threads << " threads";
  }
  omp_set_num_threads(before);
}

TEST(SymmetricPairs, LeaveOutCellsWithoutANeededParticle) {
  constexpr double radius = 0.11;
  std::array<Field, 2> x;
  for (int i = 0; i < 200; ++i) {
    x[0].push_back(0.05 * (i % 20));
    x[1].push_back(0.05 * (i / 20));
  }
  CellGrid<2> grid(Search::cell_grid, {});
  grid.build(x, radius, 2);
  for (auto& axis : x) grid.reorder(axis);
  // Needed: x > 0.7. The sums of these are right, those far from them are left at zero.
  const auto needed = [&](std::size_t i) { return x[0][i] > 0.7; };
  const auto any = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (needed(i)) return true;
    return false;
  };
  Field count(x[0].size(), 0.0);
  SymmetricPairLoop<2, 2, 1> loop;
  loop(grid, {x[0].data(), x[1].data()}, {count.data()}, needed, any,
       [](const auto& i, const auto& j) {
         const Simd r2 = (j[0] - i[0]) * (j[0] - i[0]) + (j[1] - i[1]) * (j[1] - i[1]);
         Simd one = 1.0;
         stdx::where(r2 > radius * radius || r2 < 1e-12, one) = 0.0;
         return PairTerms<1>{{one}, {one}};
       });
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (x[0][i] > 0.72 && x[0][i] < 0.8 && x[1][i] > 0.12 && x[1][i] < 0.3) {
      EXPECT_EQ(count[i], 12.0);  // of a square lattice within 2.2 spacings: 4 + 4 + 4
    }
    if (x[0][i] < 0.3) {
      EXPECT_EQ(count[i], 0.0);
    }
  }
}

TEST(Runs, AreCopiedAndAddedToTheLastNumber) {
  for (std::size_t n = 0; n <= 3 * simd_width; ++n) {
    std::vector<double> from(n + 2);
    for (std::size_t k = 0; k < from.size(); ++k) from[k] = static_cast<double>(k * k);
    std::vector<double> to(n + 2, -1.0);
    copy_run(from.data() + 1, n, 0.5, to.data() + 1);
    add_run(from.data() + 1, n, to.data() + 1);
    EXPECT_EQ(to.front(), -1.0);
    EXPECT_EQ(to.back(), -1.0);
    for (std::size_t k = 1; k <= n; ++k) EXPECT_EQ(to[k], 2.0 * from[k] + 0.5) << n;
  }
}

}  // namespace
}  // namespace surge
