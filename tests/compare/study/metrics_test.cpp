#include "compare/study/metrics.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using testing::front_of;
using ::testing::HasSubstr;

const WallRule wall{DimensionlessLength(4.0), DimensionlessLength(0.1)};

/// Z/L = 1 + 1.2 T until the wall at 4, sampled every dt.
DimensionlessFront straight(double dt, double shift = 0.0, double end = 3.0) {
  DimensionlessFront front;
  for (int i = 0; i * dt <= end + 1e-12; ++i) {
    const double t = i * dt;
    front.samples.push_back(
        {DimensionlessTime(t), DimensionlessLength(std::min(4.0, 1.0 + 1.2 * t + shift))});
  }
  return front;
}

TEST(Difference, OfARunFromItselfIsZero) {
  const FrontDifference d = difference(straight(0.1), straight(0.1), wall);
  EXPECT_EQ(d.rms, 0.0);
  EXPECT_EQ(d.maximum, 0.0);
  EXPECT_EQ(d.bias, 0.0);
  EXPECT_NEAR(d.window.end.value(), 2.9 / 1.2, 1e-12);
  for (const auto& arrival : d.arrival) EXPECT_EQ(arrival.value().value(), 0.0);
}

TEST(Difference, OfAKnownShiftIsThatShift) {
  for (const double shift : {0.06, -0.06}) {
    const FrontDifference d = difference(straight(0.1, shift), straight(0.07), wall);
    EXPECT_NEAR(d.rms, 0.06, 1e-12);
    EXPECT_NEAR(d.maximum, 0.06, 1e-12);
    EXPECT_NEAR(d.bias, shift, 1e-12);
    for (const auto& arrival : d.arrival) EXPECT_NEAR(arrival.value().value(), -shift / 1.2, 1e-12);
    // Whichever is first ends the window.
    EXPECT_NEAR(d.window.end.value(), (2.9 - std::max(shift, 0.0)) / 1.2, 1e-12);
  }
}

TEST(Difference, IsAnIntegralThatSamplingDoesNotChange) {
  // d = 0.1 T: rms = 0.1 W / sqrt(3), bias = 0.05 W, maximum 0.1 W at the end.
  const auto run = front_of({{0, 1}, {0.01, 1.013}, {0.02, 1.026}, {2, 3.6}});
  const auto reference = front_of({{0, 1}, {1.1, 2.32}, {1.7, 3.04}, {2, 3.4}});
  const FrontDifference d = difference(run, reference, wall);
  EXPECT_NEAR(d.rms, 0.2 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d.bias, 0.1, 1e-12);
  EXPECT_NEAR(d.maximum, 0.2, 1e-12);
  EXPECT_NEAR(d.time_of_maximum.value(), 2.0, 1e-12);
}

TEST(Difference, KeepsNegativeMaximumAndSign) {
  const FrontDifference d =
      difference(front_of({{0, 1}, {1, 1.8}, {2, 3}}), front_of({{0, 1}, {2, 3}}), wall);
  EXPECT_NEAR(d.maximum, 0.2, 1e-12);
  EXPECT_NEAR(d.bias, -0.1, 1e-12);
  EXPECT_NEAR(d.time_of_maximum.value(), 1.0, 1e-12);
}

TEST(Difference, LeavesArrivalsThatAreNotReachedEmpty) {
  const FrontDifference d = difference(straight(0.1, 0, 1.0), straight(0.1), wall);
  EXPECT_TRUE(d.arrival[0].has_value());
  EXPECT_TRUE(d.arrival[1].has_value());
  EXPECT_FALSE(d.arrival[2].has_value());
  EXPECT_NEAR(d.window.end.value(), 1.0, 1e-12);
}

TEST(Difference, WithoutCommonWindowIsAnError) {
  const auto early = front_of({{0, 1}, {1, 2}});
  const auto late = front_of({{1.5, 2}, {3, 3}});
  EXPECT_THAT(error_of([&] { (void)difference(early, late, wall); }), HasSubstr("window: "));
  EXPECT_THAT(error_of([&] {
                (void)difference(early, front_of({{0, 1}}), wall);
              }),
              HasSubstr("1 samples"));
  // At the wall from the start.
  EXPECT_THAT(error_of([&] {
                (void)difference(early, front_of({{0, 4}, {1, 4}}), wall);
              }),
              HasSubstr("window: "));
}

TEST(Difference, WithoutAWallGoesToTheEnd) {
  EXPECT_NEAR(common_window(straight(0.1), straight(0.1), {}).end.value(), 3.0, 1e-12);
}

PublishedSeries series_of(const DimensionlessFront& front, std::string name = "s") {
  PublishedSeries series;
  series.name = std::move(name);
  series.front = front;
  return series;
}

TEST(Series, LateGateIsFoundAsAShift) {
  // The published points are late by 0.2 in T, so behind by 0.24 in Z/L.
  DimensionlessFront points;
  for (const double t : {0.6, 1.0, 1.4, 1.8, 2.2}) {
    points.samples.push_back({DimensionlessTime(t), DimensionlessLength(1.0 + 1.2 * (t - 0.2))});
  }
  const SeriesComparison c = against_series(straight(0.05), series_of(points), wall);
  EXPECT_NEAR(c.raw.rms, 0.24, 1e-12);
  EXPECT_NEAR(c.raw.bias, 0.24, 1e-12);
  EXPECT_NEAR(c.shift.value(), -0.2, 1e-9);
  EXPECT_NEAR(c.shifted.rms, 0.0, 1e-9);
  EXPECT_EQ(c.shifted.points, 5U);
}

TEST(Series, PointsOutsideTheRunAreNotUsed) {
  const auto points = front_of({{-1, 1}, {1, 2.2}, {1.5, 2.8}, {2.9, 4.4}, {5, 9}});
  const SeriesComparison c = against_series(straight(0.1), series_of(points), wall);
  EXPECT_EQ(c.raw.points, 2U);
  EXPECT_NEAR(c.raw.rms, 0.0, 1e-12);
  EXPECT_THAT(error_of([&] {
                (void)against_series(straight(0.1), series_of(front_of({{8, 1}, {9, 2}})), wall);
              }),
              HasSubstr("0 points inside"));
}

TEST(ImpactTime, IsBetweenTheFramesAroundIt) {
  FrontHistory history;
  for (const auto& [t, x] : {std::pair{0.24, 0.55}, {0.25, 0.575}, {0.26, 0.58}, {0.27, 0.58}}) {
    history.push_back({Seconds(t), Metres(x)});
  }
  const auto hit = impact(history, Metres(0.58), Metres(0.005)).value();
  EXPECT_NEAR(hit.time.value(), 0.255, 1e-12);
  EXPECT_EQ(hit.before, Seconds(0.25));
  EXPECT_EQ(hit.after, Seconds(0.26));
  EXPECT_FALSE(impact(history, Metres(0.7), Metres(0.005)).has_value());
}

/// A measured run without files.
MeasuredRun measured(const std::string& name, const std::string& method,
                     const DimensionlessFront& front) {
  class NoFrames : public FrameReader {
   public:
    explicit NoFrames(std::size_t n) : times_(n) {}
    [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }
    [[nodiscard]] Frame read(std::size_t, Fields) override { throw Error("none"); }

   private:
    std::vector<Seconds> times_;
  };
  MeasuredRun m;
  m.run.name = name;
  m.run.method = method;
  m.run.preset = "paper";
  m.run.spacing = Metres(0.005);
  m.run.physics = testing::dam_break();
  m.run.manifest = testing::dam_break_manifest();
  m.run.frames = std::make_unique<NoFrames>(front.samples.size());
  m.front = front;
  const Scales scales = m.run.physics.scales();
  for (const auto& s : front.samples) {
    m.history.push_back({scales.dimensional(s.time), scales.dimensional(s.position)});
  }
  return m;
}

TEST(MetricsJson, HoldsWhatTheReportNeeds) {
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("mps-paper-0.005", "mps", straight(0.1, 0.05)));
  runs.push_back(measured("vof-20", "vof", straight(0.1)));
  runs[1].run.cells_per_width = 20;
  const nlohmann::json out = metrics(runs, "vof-20", {}, {});
  const nlohmann::json& mps = out.at("front").at("mps-paper-0.005");
  EXPECT_EQ(mps.at("method"), "mps");
  EXPECT_EQ(mps.at("preset"), "paper");
  EXPECT_EQ(mps.at("spacing_m"), 0.005);
  EXPECT_NEAR(mps.at("rms_vs_vof").get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(mps.at("max_vs_vof").get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(mps.at("bias_vs_vof").get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(mps.at("arrival_T_difference").at("1.5").get<double>(), -0.05 / 1.2, 1e-12);
  EXPECT_NEAR(mps.at("arrival_T").at("2.0").get<double>(), 0.95 / 1.2, 1e-12);
  // An arrival is known no better than the frames are dense.
  const auto between = mps.at("arrival_between_T").at("2.0").get<std::array<double, 2>>();
  EXPECT_LE(between[0], 0.95 / 1.2);
  EXPECT_GE(between[1], 0.95 / 1.2);
  EXPECT_NEAR(mps.at("arrival_u_T").at("2.0").get<double>(),
              (between[1] - between[0]) / std::sqrt(12.0), 1e-12);
  EXPECT_GT(mps.at("arrival_u_T_difference").at("2.0").get<double>(),
            mps.at("arrival_u_T").at("2.0").get<double>());
  const auto hit = mps.at("impact_between_s").get<std::array<double, 2>>();
  EXPECT_NEAR(mps.at("impact_u_s").get<double>(), (hit[1] - hit[0]) / std::sqrt(12.0), 1e-12);
  EXPECT_EQ(mps.at("window_T").at(0), 0.0);
  EXPECT_TRUE(mps.at("impact_time_s").is_number());
  EXPECT_EQ(out.at("front").at("vof-20").at("cells_per_L"), 20);
  EXPECT_EQ(out.at("front").at("vof-20").at("rms_vs_vof"), 0.0);
  const nlohmann::json& timing = out.at("timing").at("mps-paper-0.005");
  EXPECT_EQ(timing.at("wall_s"), 2.5);
  EXPECT_EQ(timing.at("steps"), 1200);
  EXPECT_EQ(timing.at("particles"), 1682);
  EXPECT_EQ(timing.at("threads"), 1);
}

TEST(MetricsJson, ComparesWithNoSeriesOfAnotherCase) {
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("a", "mps", straight(0.1)));
  runs.push_back(measured("b", "vof", straight(0.1)));
  PublishedSeries same = series_of(straight(0.3), "same");
  PublishedSeries other = series_of(straight(0.3), "other");
  same.of.column_height = 2.0;
  other.of.column_height = 1.0;
  const nlohmann::json found = metrics(runs, "b", {same, other}, {})["front"]["a"]["published"];
  EXPECT_EQ(found["same"]["status"], "passed");
  EXPECT_EQ(found["other"]["status"], "skipped");
  EXPECT_THAT(found["other"]["reason"].get<std::string>(),
              HasSubstr("height of the column: 1.00 L in the series, 2.00 L in the run"));
  EXPECT_FALSE(found["other"].contains("raw"));
}

TEST(MetricsJson, SaysWhatOtherChoicesOfTheFrontDo) {
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("a", "mps", straight(0.1)));
  runs.push_back(measured("b", "vof", straight(0.1)));
  const MeasuredRun other = measured("c", "mps", straight(0.1, 0.03));
  runs[0].variants.push_back({"strip_x2", other.history});
  const nlohmann::json found = metrics(runs, "b", {}, {})["front"];
  EXPECT_NEAR(found["a"]["front_sensitivity"]["strip_x2"]["max"].get<double>(), 0.03, 1e-12);
  EXPECT_FALSE(found["b"].contains("front_sensitivity"));
}

TEST(MetricsJson, RefusesOtherPhysicsUnlessAllowed) {
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("a", "mps", straight(0.1)));
  runs.push_back(measured("b", "vof", straight(0.1)));
  runs[1].run.physics.wall = "no-slip";
  EXPECT_THAT(error_of([&] { (void)metrics(runs, "b", {}, {}); }),
              HasSubstr("wall: slip in a, no-slip in b"));
  MetricsOptions options;
  options.allowed_differences = {"wall"};
  EXPECT_NO_THROW((void)metrics(runs, "b", {}, options));
}

TEST(MetricsJson, RefusesMissingOrUnfinishedReferenceAndDoubledNames) {
  std::vector<MeasuredRun> runs;
  runs.push_back(measured("a", "mps", straight(0.1)));
  EXPECT_THAT(error_of([&] { (void)metrics(runs, "b", {}, {}); }), HasSubstr("reference: b"));
  runs.push_back(measured("a", "vof", straight(0.1)));
  EXPECT_THAT(error_of([&] { (void)metrics(runs, "a", {}, {}); }), HasSubstr("a found twice"));
  runs[0].run.manifest["finished"] = false;
  EXPECT_THAT(error_of([&] { (void)metrics(runs, "a", {}, {}); }), HasSubstr("did not finish"));
}

}  // namespace
}  // namespace surge::compare
