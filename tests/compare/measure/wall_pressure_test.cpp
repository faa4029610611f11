#include "compare/measure/wall_pressure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "compare/study/wall_pressures.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using testing::dam_break;
using testing::error_of;
using ::testing::HasSubstr;
using testing::SyntheticStudy;
using testing::write_text;

constexpr double scale = 1000.0 * 9.81 * 0.29;  // rho g H, Pa

/// p(t) at equal steps from 0 to the end.
template <class F>
PressureSignal signal_of(F p, double step, double end = 0.5) {
  std::vector<double> time, pressure;
  for (int k = 0; k * step <= end; ++k) {
    time.push_back(k * step);
    pressure.push_back(p(time.back()));
  }
  return {time, pressure};
}

double sinc(double x) {
  return std::sin(x) / x;
}

TEST(WallPressure, IntegralOfLinearPiecesIsExactAtUnevenSteps) {
  const PressureSignal signal({0.0, 1.0, 1.5, 4.0}, {0.0, 2.0, 2.0, -3.0});
  EXPECT_DOUBLE_EQ(signal.integral(0.0, 4.0), 1.0 + 1.0 - 1.25);
  EXPECT_DOUBLE_EQ(signal.integral(0.5, 1.25), 0.75 + 0.5);
  EXPECT_DOUBLE_EQ(signal.integral(2.0, 2.5), 0.25);  // from 1 to 0
  EXPECT_DOUBLE_EQ(signal.mean(1.0, 0.5), (0.4375 + 0.5) / 0.5);
  EXPECT_DOUBLE_EQ(*signal.median_step(0.0, 4.0), 1.0);
}

TEST(WallPressure, ConstantPressureHasItsImpulseAndNoNoise) {
  const auto found = impact_pressure(signal_of([](double) { return 1.5 * scale; }, 1e-3),
                                     dam_break(), Seconds(0.2));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->peak, 1.5, 1e-12);
  EXPECT_NEAR(found->impulse, 1.5 * impact_duration.value(), 1e-12);
  EXPECT_NEAR(found->noise, 0.0, 1e-11);
  ASSERT_TRUE(found->readable_from);
  EXPECT_DOUBLE_EQ(found->readable_from->value(), 0.0);
}

TEST(WallPressure, IsReadableWhereTheNoiseHasLeftTheInterval) {
  // A sine of amplitude 0.5 on a load of 2 until t_1. An interval of 101 values with n of them from
  // the sine has the noise 0.5 sqrt(n/101/2), which is a tenth of 2 at n = 32.3, so that the first
  // quiet interval has its middle 50 - 32 values behind t_1.
  const double t0 = 0.2, t1 = 0.25, w = 2.0 * std::numbers::pi * 2000.0;
  const auto burst = [&](double t) {
    return scale * (2.0 + (t < t1 ? 0.5 * std::sin(w * t) : 0.0));
  };
  const auto found = impact_pressure(signal_of(burst, 1e-6), dam_break(), Seconds(t0));
  ASSERT_TRUE(found);
  ASSERT_TRUE(found->readable_from);
  const double seconds = dam_break().scales().dimensional(*found->readable_from).value();
  EXPECT_NEAR(seconds, t1 - t0 + 18 * sensor_interval.value(), 4 * sensor_interval.value());
}

TEST(WallPressure, IsNeverReadableWhereTheNoiseLasts) {
  const double w = 2.0 * std::numbers::pi * 2000.0;
  const auto found = impact_pressure(
      signal_of([&](double t) { return scale * (2.0 + 0.5 * std::sin(w * t)); }, 1e-6), dam_break(),
      Seconds(0.2));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->readable_from);
}

TEST(WallPressure, SteadyRiseIsNoNoise) {
  // p = rho g H (1 + a (t - t0)): its moving mean is itself.
  const double t0 = 0.2, a = 10.0;
  const auto found =
      impact_pressure(signal_of([&](double t) { return scale * (1.0 + a * (t - t0)); }, 1e-3),
                      dam_break(), Seconds(t0));
  ASSERT_TRUE(found);
  const Scales scales = dam_break().scales();
  const double duration = scales.dimensional(impact_duration).value();
  EXPECT_NEAR(found->noise, 0.0, 1e-11);
  EXPECT_NEAR(found->peak, 1.0 + a * duration, a * sensor_interval.value());
  EXPECT_NEAR(found->time_of_peak.value(), impact_duration.value(), 1e-3);
  EXPECT_NEAR(found->impulse, impact_duration.value() * (1.0 + 0.5 * a * duration), 1e-9);
}

TEST(WallPressure, SineHasTheNoiseThatTheIntervalsLeaveOfIt) {
  // The mean of a sin(w t) over d is a sin(w t) sinc(w d / 2), so that p_k - m_k is the sine
  // times a (sinc(w d / 2) - sinc(w D / 2)), and its root mean square 1/sqrt(2) of that.
  for (const double frequency : {130.0, 1000.0, 7000.0}) {
    const double w = 2.0 * std::numbers::pi * frequency, amplitude = 0.4;
    const auto found = impact_pressure(
        signal_of([&](double t) { return scale * (2.0 + amplitude * std::sin(w * t)); }, 1e-6),
        dam_break(), Seconds(0.2));
    ASSERT_TRUE(found);
    const double kept = sinc(0.5 * w * sensor_interval.value());
    const double taken = sinc(0.5 * w * noise_interval.value());
    EXPECT_NEAR(found->noise, amplitude * std::abs(kept - taken) / std::numbers::sqrt2, 2e-3);
    EXPECT_NEAR(found->peak, 2.0 + amplitude * kept, 1e-3);
    EXPECT_NEAR(found->impulse, 2.0 * impact_duration.value(), 0.02);
  }
}

TEST(WallPressure, SpikeShorterThanTheSensorKeepsItsImpulseNotItsHeight) {
  // A triangle of 100 rho g H, 2e-5 s at its foot: 1e-3 s rho g H.
  const double hit = 0.25;
  const auto spike = [&](double t) {
    return scale * 100.0 * std::max(0.0, 1.0 - std::abs(t - hit) / 1e-5);
  };
  const auto found =
      impact_pressure(signal_of(spike, 1e-6), dam_break(), Seconds(hit - 400 * 5e-5));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->peak, 1e-3 / sensor_interval.value(), 1e-4);
  EXPECT_NEAR(found->impulse, 1e-3 * std::sqrt(2.0 * 9.81 / 0.145), 1e-6);
}

TEST(WallPressure, SignalThatEndsBeforeTheImpactIsOverHasNoNumbers) {
  EXPECT_FALSE(
      impact_pressure(signal_of([](double) { return 1.0; }, 1e-3, 0.3), dam_break(), Seconds(0.2)));
}

TEST(WallPressure, TimesThatDoNotIncreaseAreAnError) {
  EXPECT_THAT(error_of([] {
                PressureSignal({0.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
              }),
              HasSubstr("increasing"));
}

TEST(WallPressure, IsReadFromTheColumnOfItsName) {
  const SyntheticStudy files;
  write_text(files.runs() / "mps-a/steps.csv",
             "time,other,wall_pressure,more\n0,9,10,9\n0.25,9,-20,9\n");
  const compare::Run run = open_run(files.runs() / "mps-a");
  const PressureSignal signal = read_wall_pressure(run);
  EXPECT_EQ(signal.time(), (std::vector<double>{0.0, 0.25}));
  EXPECT_EQ(signal.pressure(), (std::vector<double>{10.0, -20.0}));
  write_text(files.runs() / "mps-a/steps.csv", "time,wall_pressure\n0,1\n0.25\n");
  EXPECT_THAT(error_of([&] { static_cast<void>(read_wall_pressure(run)); }),
              HasSubstr("steps.csv:3: found no column 2"));
  write_text(files.runs() / "mps-a/steps.csv", "time,elsewhere\n0,1\n");
  EXPECT_THAT(error_of([&] { static_cast<void>(read_wall_pressure(run)); }),
              HasSubstr("found no column wall_pressure"));
}

TEST(WallPressure, IsReadFromTheTableOfTheFoamCase) {
  const testing::TemporaryFolder folder;
  write_text(folder / "postProcessing/wallPressure/0/p",
             "# Probe 0 (0.58 0.0145 0.0725)\n#       Probe             0\n#        Time\n"
             "         0.001        12.5\n         0.003       -2e-1\n");
  compare::Run run;
  run.path = folder.path();
  run.kind = SourceKind::openfoam;
  const PressureSignal signal = read_wall_pressure(run);
  EXPECT_EQ(signal.time(), (std::vector<double>{0.001, 0.003}));
  EXPECT_EQ(signal.pressure(), (std::vector<double>{12.5, -0.2}));
}

TEST(WallPressure, ProbeAtAnotherPlaceIsNotCompared) {
  const SyntheticStudy files;
  const auto manifest = files.runs() / "mps-a/manifest.json";
  std::string text = testing::read_text(manifest);
  const auto at = text.find("0.0145");
  ASSERT_NE(at, std::string::npos);
  write_text(manifest, text.replace(at, 6, "0.0290"));
  const StudyResult study = files.collected();
  const auto results = wall_pressures(study);
  ASSERT_EQ(results.size(), 3U);
  for (const WallPressureResult& result : results) {
    const bool other = result.run->study.name == "mps-a";
    EXPECT_EQ(result.found.has_value(), !other) << result.note;
    EXPECT_EQ(result.note, other ? "its probe is at another place" : "");
  }
}

}  // namespace
}  // namespace surge::compare
