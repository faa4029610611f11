#include "compare/study/curve_measures.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace surge::compare {
namespace {

/// Up from 0 to 2 at t = 1, down to 0 at t = 3.
const Curve tent{{0.0, 1.0, 3.0}, {0.0, 2.0, 0.0}};

TEST(CurveMeasures, OfATentAreExact) {
  const auto of = [](CurveMeasure measure, const CurveOptions& options = {}) {
    return curve_value(measure, tent, options).value_or(-1.0);
  };
  EXPECT_DOUBLE_EQ(of(CurveMeasure::arrival, {0.5, {}}), 0.25);
  EXPECT_DOUBLE_EQ(of(CurveMeasure::peak), 2.0);
  EXPECT_DOUBLE_EQ(of(CurveMeasure::peak_time), 1.0);
  EXPECT_DOUBLE_EQ(of(CurveMeasure::impulse), 3.0);
  EXPECT_NEAR(of(CurveMeasure::final), 0.15, 1e-12);  // mean over 2.7 to 3
  EXPECT_FALSE(curve_value(CurveMeasure::arrival, tent, {2.5, {}}));
  EXPECT_FALSE(curve_value(CurveMeasure::arrival, tent.within(1.0, 3.0), {0.5, {}}));
}

TEST(CurveMeasures, FitAnOscillation) {
  const double period = 1.3, w = 2.0 * std::numbers::pi / period;
  Curve wave;
  for (int i = 0; i <= 400; ++i) {
    wave.first.push_back(2.6 * i / 400.0);
    wave.value.push_back(0.6 + 0.03 * std::cos(w * (wave.first.back() - 0.2)));
  }
  const CurveOptions options{{}, period};
  EXPECT_NEAR(*curve_value(CurveMeasure::amplitude, wave, options), 0.03, 1e-9);
  EXPECT_NEAR(*curve_value(CurveMeasure::phase, wave, options), 0.2, 1e-9);
  EXPECT_FALSE(curve_value(CurveMeasure::phase, wave.within(0.0, 1.0), options));
}

TEST(CurveMeasures, DifferencesAreExactForStraightPieces) {
  const Curve flat{{-1.0, 2.0}, {1.0, 1.0}};
  const auto d = curve_difference(tent, flat);  // 2t - 1 up to 1, then 2 - t up to 2
  ASSERT_TRUE(d);
  EXPECT_DOUBLE_EQ(d->begin, 0.0);
  EXPECT_DOUBLE_EQ(d->end, 2.0);
  EXPECT_NEAR(d->rms, std::sqrt((1.0 / 3.0 + 1.0 / 3.0) / 2.0), 1e-12);
  EXPECT_NEAR(d->bias, 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(d->maximum, 1.0);
  EXPECT_FALSE(curve_difference(tent, Curve{{4.0, 5.0}, {0.0, 0.0}}));
}

TEST(CurveMeasures, PointsAndShift) {
  const Curve points{{0.4, 0.9, 3.5}, {0.5, 1.5, 9.0}};  // 0.15 late of the tent; the last outside
  const auto d = point_difference(tent, points);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->points, 2U);
  EXPECT_NEAR(d->rms, 0.3, 1e-12);
  const std::vector<ShiftedPair> alone{{&tent, points, 1.0}};
  EXPECT_NEAR(best_shift(alone, 0.5), -0.15, 1e-9);
  EXPECT_DOUBLE_EQ(best_shift(alone, 0.0), 0.0);
}

// d_k = s_k + t of the lines y = x: sum ((s_k + t)/scale_k)^2 is least at the mean of -s_k,
// weighted by 1/scale_k^2.
TEST(CurveMeasures, OneShiftOfSeveralCurvesIsTheirWeightedMean) {
  const Curve line{{0.0, 10.0}, {0.0, 10.0}};
  const auto late = [&](double by, double scale) {
    return ShiftedPair{&line, {{4.0 + by, 5.0 + by, 6.0 + by}, {4.0, 5.0, 6.0}}, scale};
  };
  const std::vector<ShiftedPair> equal{late(0.1, 1.0), late(0.3, 1.0)};
  EXPECT_NEAR(best_shift(equal, 0.5), -0.2, 1e-3);
  const std::vector<ShiftedPair> unequal{late(0.1, 1.0), late(0.4, 0.5)};
  EXPECT_NEAR(best_shift(unequal, 0.5), -(0.1 + 4.0 * 0.4) / 5.0, 1e-3);
  // One that shares no points has no say.
  const Curve elsewhere{{20.0, 21.0}, {0.0, 1.0}};
  const std::vector<ShiftedPair> third{
      late(0.1, 1.0), late(0.3, 1.0), {&elsewhere, equal[0].published, 1.0}};
  EXPECT_NEAR(best_shift(third, 0.5), -0.2, 1e-3);
}

TEST(CurveMeasures, NothingIsExtrapolated) {
  EXPECT_FALSE(tent.at(-0.1));
  EXPECT_FALSE(tent.at(3.1));
  EXPECT_DOUBLE_EQ(*tent.at(3.0), 0.0);
  EXPECT_EQ(tent.within(0.5, 2.0).first, (std::vector<double>{0.5, 1.0, 2.0}));
}

}  // namespace
}  // namespace surge::compare
