#include "particle/sph/cluster_lists.hpp"

#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace surge::sph {
namespace {

struct Layout {
  Search search;
  bool periodic;
  std::size_t particles;
  double radius = 0.11;
};

template <int D>
Periodicity<D> unit_period(bool on) {
  Periodicity<D> p;
  if (on) p.length.fill(1.0);
  return p;
}

/// Particles anywhere in the unit square (cube), every third of them a wall, with a charge that
/// each shows to the others and one that it sees itself.
template <int D>
struct Cloud {
  Particles<D> p;
  Field charge;
  Field own;
  CellGrid<D> grid;
  ClusterLists<D> lists;
  std::array<Field, 4> sums;

  explicit Cloud(const Layout& s) : grid(s.search, unit_period<D>(s.periodic)) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    p.resize(s.particles);
    for (std::size_t i = 0; i < s.particles; ++i) {
      for (int a = 0; a < D; ++a) p.x[a][i] = unit(random);
      p.type[i] = i % 3 == 0 ? ParticleType::wall : ParticleType::fluid;
      charge.push_back(unit(random));
      own.push_back(unit(random));
    }
    grid.build(p.x, s.radius, 2);
    grid.reorder(p);
    grid.reorder(charge);
    grid.reorder(own);
    lists.build(grid, p, s.radius);
    for (Field& field : sums) field.assign(s.particles, 99.0);
    add_up(s.radius, ClusterLists<D>::Of::fluid);
    add_up(s.radius, ClusterLists<D>::Of::walls);
  }
  [[nodiscard]] bool is_fluid(std::size_t i) const { return p.type[i] == ParticleType::fluid; }

 private:
  void add_up(double radius, typename ClusterLists<D>::Of kind) {
    std::array<const double*, D + 2> in;
    std::array<double*, 4> out;
    for (int a = 0; a < D; ++a) in[a] = p.x[a].data();
    in[D] = charge.data();
    in[D + 1] = own.data();
    for (int k = 0; k < 4; ++k) out[k] = sums[k].data();
    lists.template sum<D + 2, D + 1, 4>(
        kind, in, out,
        [&](const Offset<D>& offset, const auto& i, const auto& j, auto& total, auto fluid) {
          Simd weight = stdx::max(Simd(radius * radius) - offset.r2, Simd(0.0));
          stdx::where(offset.r2 < Simd(2.0 * tiny), weight) = 0.0;
          total[0] += weight;
          total[1] += weight * offset.dx[0];
          total[2] += weight * j[D] * i[D + 1];
          if constexpr (fluid()) total[3] += weight;
        });
  }
};

/// Walls meet fluid only, of which they have a sum where there is any.
template <int D>
void expect_the_definition(const Layout& s) {
  const Cloud<D> c(s);
  const std::size_t stride = s.particles < 10000 ? 7 : 97;
  for (std::size_t i = 0; i < s.particles; i += stride) {
    std::array<double, 4> expected{};
    for (std::size_t j = 0; j < s.particles; ++j) {
      if (i == j || !(c.is_fluid(i) || c.is_fluid(j))) continue;
      std::array<double, D> dx;
      double r2 = 0.0;
      for (int a = 0; a < D; ++a) {
        dx[a] = c.p.x[a][j] - c.p.x[a][i];
        if (s.periodic) dx[a] -= std::nearbyint(dx[a]);
        r2 += dx[a] * dx[a];
      }
      if (r2 >= s.radius * s.radius) continue;
      const double weight = s.radius * s.radius - r2;
      expected[0] += weight;
      expected[1] += weight * dx[0];
      expected[2] += weight * c.charge[j] * c.own[i];
      if (c.is_fluid(j)) expected[3] += weight;
    }
    if (!c.is_fluid(i) && expected[3] == 0.0) continue;
    for (int k = 0; k < 4; ++k)
      ASSERT_NEAR(c.sums[k][i], expected[k], 1e-13) << "sum " << k << " of particle " << i;
  }
}

class Clusters : public testing::TestWithParam<Layout> {};

TEST_P(Clusters, MeetAllNeighboursOnce2D) {
  expect_the_definition<2>(GetParam());
}
TEST_P(Clusters, MeetAllNeighboursOnce3D) {
  expect_the_definition<3>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Setups, Clusters,
    testing::Values(Layout{Search::cell_grid, false, 900}, Layout{Search::cell_grid, false, 2500},
                    Layout{Search::cell_grid, true, 900},
                    Layout{Search::cell_grid, true, 2500, 0.2}, Layout{Search::cell_grid, true, 5},
                    Layout{Search::cell_grid, false, 1},
                    Layout{Search::cell_grid, true, 40000, 0.018},
                    Layout{Search::all_pairs, false, 900}, Layout{Search::all_pairs, true, 500}));

TEST(Clusters, SumsAreTheSameWhateverTheNumberOfThreads) {
  const int before = omp_get_max_threads();
  const Layout layout{Search::cell_grid, true, 20000};
  omp_set_num_threads(1);
  const Cloud<2> one(layout);
  for (const int threads : {2, 3, 7}) {
    omp_set_num_threads(threads);
    const Cloud<2> many(layout);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(one.sums[k], many.sums[k]) << threads << " threads";
  }
  omp_set_num_threads(before);
}

/// A lattice of walls with fluid at x > 0.7.
struct Shore {
  Particles<2> p;
  CellGrid<2> grid{Search::cell_grid, {}};
  ClusterLists<2> lists;

  Shore() {
    p.resize(400);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.x[0][i] = 0.05 * static_cast<double>(i % 20);
      p.x[1][i] = 0.05 * static_cast<double>(i / 20);
      p.type[i] = p.x[0][i] > 0.72 ? ParticleType::fluid : ParticleType::wall;
    }
    grid.build(p.x, 0.12, 2);
    grid.reorder(p);
    lists.build(grid, p, 0.12);
  }
};

TEST(Clusters, WallsAwayFromTheWaterHaveNoList) {
  const Shore shore;
  const auto& p = shore.p;
  std::vector<int> met(p.size(), 0);
  for (const auto kind : {ClusterLists<2>::Of::fluid, ClusterLists<2>::Of::walls})
    shore.lists.for_each(kind, [&](std::size_t i) {
      ++met[i];
      EXPECT_EQ(p.type[i] == ParticleType::fluid, kind == ClusterLists<2>::Of::fluid);
    });
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.x[0][i] > 0.62) {
      EXPECT_EQ(met[i], 1) << p.x[0][i];
    }
    // A cluster may reach a little farther than its particles that are near.
    if (p.x[0][i] < 0.4) {
      EXPECT_EQ(met[i], 0) << p.x[0][i];
    }
  }
}

TEST(Clusters, ThatAreNotWantedGetZero) {
  Shore shore;
  const auto& p = shore.p;
  Field count(p.size(), 99.0);
  using Lists = ClusterLists<2>;
  shore.lists.sum<2, 2, 1>(
      Lists::Of::fluid, {p.x[0].data(), p.x[1].data()}, {count.data()},
      [](const auto&, const auto&, const auto&, auto& total, auto) { total[0] += 1.0; },
      [&](const Lists::Row& row, const Lists::Cluster& cluster) {
        bool any = false;
        row.for_each_fluid_neighbour(cluster,
                                     [&](std::size_t j) { any = any || p.x[1][j] > 0.72; });
        return any;
      });
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] != ParticleType::fluid) {
      EXPECT_EQ(count[i], 99.0);
    } else if (p.x[1][i] > 0.62) {
      EXPECT_GE(count[i], 6.0);
    } else if (p.x[1][i] < 0.5) {
      EXPECT_EQ(count[i], 0.0);
    }
  }
}

// Two that were just out of reach of lists that are 0.1 longer than the kernel. Moved towards each
// other by 0.1 they are still no neighbours; by more they are, which the lists do not know.
// A pair that is beyond kernel and skin need not be listed (in a wide cluster it may be), and is
// not needed before it has come nearer by the skin; one that is within them is found wherever it
// goes.
TEST(Clusters, AListServesUntilItsParticlesHaveApproachedByItsSkin) {
  constexpr double kernel = 1.0;
  constexpr double skin = 0.1;
  struct Pair {
    double apart, approach, found;
  };
  for (const Pair pair :
       {Pair{1.0005 * (kernel + skin), 0.0, 1.0}, Pair{1.0005 * (kernel + skin), 0.999 * skin, 1.0},
        Pair{0.9995 * (kernel + skin), 0.5 * skin, 1.0},
        Pair{0.9995 * (kernel + skin), 1.5 * skin, 2.0}}) {
    Particles<2> p;
    p.resize(2);
    p.x[0] = {0.0, pair.apart};
    CellGrid<2> grid(Search::cell_grid, {});
    grid.build(p.x, kernel + skin, 2);
    grid.reorder(p);
    ClusterLists<2> lists;
    lists.build(grid, p, kernel + skin);
    p.x[0][0] += 0.5 * pair.approach;
    p.x[0][1] -= 0.5 * pair.approach;
    Field count(2, 99.0);
    lists.sum<2, 2, 1>(ClusterLists<2>::Of::fluid, {p.x[0].data(), p.x[1].data()}, {count.data()},
                       [&](const auto& offset, const auto&, const auto&, auto& total, auto) {
                         Simd one = 1.0;
                         stdx::where(offset.r2 >= Simd(kernel * kernel), one) = 0.0;
                         total[0] += one;
                       });
    // Themselves, and the other where it is within the kernel.
    EXPECT_EQ(count[0], pair.found) << pair.apart << ' ' << pair.approach;
    EXPECT_EQ(count[1], pair.found) << pair.apart << ' ' << pair.approach;
  }
}

}  // namespace
}  // namespace surge::sph
