#include "compare/study/convergence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using ::testing::HasSubstr;

/// phi = limit + c h^p at three sizes.
std::array<Level, 3> power(double limit, double c, double p, std::array<double, 3> h) {
  std::array<Level, 3> levels;
  for (std::size_t i = 0; i < 3; ++i) levels[i] = {h[i], limit + c * std::pow(h[i], p)};
  return levels;
}

TEST(Convergence, FindsOrderAndLimitOfAManufacturedSequence) {
  for (const double p : {0.8, 1.0, 1.5, 2.0}) {
    for (const auto& h : std::vector<std::array<double, 3>>{
             {1.0, 2.0, 4.0}, {0.0025, 0.005, 0.145 / 15}, {1.0, 1.5, 6.0}, {1.0, 4.0, 6.0}}) {
      for (const double c : {0.3, -2.0}) {
        const GridConvergence found = grid_convergence(power(2.5, c, p, h));
        EXPECT_EQ(found.approach, Approach::monotone);
        ASSERT_TRUE(found.order);
        EXPECT_NEAR(*found.order, p, 1e-6);
        EXPECT_NEAR(*found.extrapolated, 2.5, 1e-8);
        EXPECT_NEAR(*found.gci21, 1.25 * std::abs(c) * std::pow(h[0], p), 1e-8);
        EXPECT_NEAR(*found.gci32, 1.25 * std::abs(c) * std::pow(h[1], p), 1e-8);
        EXPECT_NEAR(found.uncertainty, *found.gci21, 1e-8);
        EXPECT_TRUE(found.asymptotic()) << found.doubts.front();
      }
    }
  }
}

/// Table 1 of Celik et al. (2008): the three sample calculations.
TEST(Convergence, ReproducesTheSamplesOfCelikAndOthers) {
  // phi on n1 > n2 > n3 cells in two dimensions.
  const auto sample = [&](std::array<double, 3> cells, std::array<double, 3> phi) {
    std::array<Level, 3> levels;
    for (std::size_t i = 0; i < 3; ++i) levels[i] = {std::sqrt(1.0 / cells[i]), phi[i]};
    return grid_convergence(levels);
  };
  const GridConvergence length = sample({18000, 8000, 4500}, {6.063, 5.972, 5.863});
  EXPECT_EQ(length.approach, Approach::monotone);
  EXPECT_NEAR(*length.order, 1.53, 0.01);
  EXPECT_NEAR(*length.extrapolated, 6.1685, 1e-3);
  EXPECT_NEAR(*length.gci21 / 6.063, 0.022, 5e-4);
  EXPECT_TRUE(length.asymptotic());

  const GridConvergence speed = sample({18000, 4500, 980}, {10.7880, 10.7250, 10.6050});
  EXPECT_NEAR(*speed.order, 0.75, 0.01);
  EXPECT_NEAR(*speed.extrapolated, 10.8801, 2e-3);
  EXPECT_NEAR(*speed.gci21 / 10.7880, 0.011, 5e-4);

  const GridConvergence swinging = sample({18000, 4500, 980}, {6.0042, 5.9624, 6.0909});
  EXPECT_EQ(swinging.approach, Approach::oscillating);
  EXPECT_NEAR(*swinging.order, 1.51, 0.01);
  EXPECT_NEAR(*swinging.extrapolated, 6.0269, 1e-3);
  EXPECT_NEAR(*swinging.gci21 / 6.0042, 0.005, 5e-4);
  EXPECT_THAT(swinging.doubts, ElementsAre(HasSubstr("alternate")));
}

TEST(Convergence, OscillatingSequenceHasTheOrderOfItsShrinkingSwings) {
  // Errors +e, -e/2, +e/4 at ratio 2: |eps32/eps21| = 2, order one.
  const GridConvergence found =
      grid_convergence({Level{1.0, 5.25}, Level{2.0, 4.5}, Level{4.0, 6.0}});
  EXPECT_EQ(found.approach, Approach::oscillating);
  EXPECT_NEAR(*found.order, 1.0, 1e-9);
  EXPECT_FALSE(found.asymptotic());
  EXPECT_NEAR(found.uncertainty, 1.25 * 0.75, 1e-9);
}

TEST(Convergence, DivergingSequencesGetNoOrderButAnUncertainty) {
  // One way, swinging, equal steps, and a step after a standstill.
  const std::vector<std::array<double, 3>> sequences{
      {4.0, 2.0, 1.0}, {3.0, 0.0, 1.0}, {3.0, 2.0, 1.0}, {2.0, 1.0, 1.0}};
  for (const auto& v : sequences) {
    const GridConvergence found =
        grid_convergence({Level{1.0, v[0]}, Level{2.0, v[1]}, Level{4.0, v[2]}});
    EXPECT_EQ(found.approach, Approach::diverging) << v[0];
    EXPECT_FALSE(found.order || found.extrapolated || found.gci21 || found.gci32);
    const auto [least, most] = std::minmax_element(v.begin(), v.end());
    EXPECT_DOUBLE_EQ(found.uncertainty, 3.0 * (*most - *least));
    EXPECT_THAT(found.doubts, ElementsAre(HasSubstr("shrink")));
  }
  // With unequal ratios equal changes may well converge: here at order one.
  EXPECT_EQ(grid_convergence({Level{1.0, 1.0}, Level{3.0, 3.0}, Level{5.0, 5.0}}).approach,
            Approach::monotone);
}

TEST(Convergence, ConstantSequenceIsCertainButHasNoOrder) {
  const GridConvergence found =
      grid_convergence({Level{1.0, 0.3}, Level{2.0, 0.3}, Level{4.0, 0.3}});
  EXPECT_EQ(found.approach, Approach::constant);
  EXPECT_FALSE(found.order);
  EXPECT_EQ(found.uncertainty, 0.0);
  EXPECT_FALSE(found.asymptotic());
}

TEST(Convergence, OrdersFarFromTheFormalOnesAreDoubtedAndBounded) {
  const GridConvergence slow = grid_convergence(power(1.0, 1.0, 0.1, {1.0, 2.0, 4.0}));
  EXPECT_THAT(slow.doubts.front(), HasSubstr("below"));
  const double range = std::pow(4.0, 0.1) - 1.0;
  EXPECT_NEAR(slow.uncertainty, 3.0 * range, 1e-9);  // the index would be 1.25
  const GridConvergence fast = grid_convergence(power(1.0, 1.0, 4.0, {1.0, 2.0, 4.0}));
  EXPECT_THAT(fast.doubts.front(), HasSubstr("above"));
  EXPECT_NEAR(*fast.order, 4.0, 1e-9);
  EXPECT_NEAR(*fast.gci21, 1.25, 1e-9);
  EXPECT_NEAR(fast.uncertainty, 1.25 * 15.0, 1e-9);  // as if of first order
  EXPECT_EQ(fast.doubts.size(), 1U);
  EXPECT_NEAR(*fast.index_ratio, 4.0, 1e-9);  // sixteenfold changes, of second order fourfold
}

TEST(Convergence, LevelsInBetweenSayWhetherTheCurveIsOne) {
  const auto levels = power(1.0, 1.0, 1.0, {1.0, 2.0, 4.0});  // 2, 3, 5
  EXPECT_TRUE(grid_convergence(levels, {{1.5, 2.5}, {3.0, 4.0}}).asymptotic());
  const GridConvergence off = grid_convergence(levels, {{1.5, 4.5}});
  EXPECT_THAT(off.doubts, ElementsAre(HasSubstr("off the curve")));
  EXPECT_NEAR(off.uncertainty, 1.25 * 2.5, 1e-9);  // 2 to 4.5
  // Beyond the second level it counts for the curve, not for the uncertainty; beyond the third for
  // neither.
  EXPECT_NEAR(grid_convergence(levels, {{3.0, 9.0}}).uncertainty, 1.25, 1e-9);
  EXPECT_FALSE(grid_convergence(levels, {{3.0, 9.0}}).asymptotic());
  EXPECT_TRUE(grid_convergence(levels, {{5.0, 9.0}}).asymptotic());
}

TEST(Convergence, TakesTheFinestThreeLevelsThatAreFarEnoughApart) {
  const auto found = systematic_levels({{15, 1}, {10, 2}, {7, 3}, {5, 4}, {2.5, 5}, {3.5, 6}});
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)[0].h, 2.5);
  EXPECT_EQ((*found)[1].h, 5);
  EXPECT_EQ((*found)[2].h, 10);
  // As a study states them: a third of 29 mm has no end.
  EXPECT_TRUE(systematic_levels({{14.5, 1}, {9.6666666666667, 1}, {5, 1}}));
  EXPECT_FALSE(systematic_levels({{1, 1}, {1.4, 1}, {2, 1}, {2.5, 1}}));
}

TEST(Convergence, ImpossibleLevelsAreErrors) {
  EXPECT_THAT(error_of([] {
                (void)grid_convergence({Level{2.0, 1.0}, Level{1.0, 1.0}, Level{3.0, 1.0}});
              }),
              HasSubstr("larger"));
  EXPECT_THAT(
      error_of([] {
        (void)grid_convergence({Level{1.0, std::nan("")}, Level{2.0, 1.0}, Level{3.0, 1.0}});
      }),
      HasSubstr("finite"));
}

}  // namespace
}  // namespace surge::compare
