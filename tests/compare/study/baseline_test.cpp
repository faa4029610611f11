#include "compare/study/baseline.hpp"

#include <gmock/gmock.h>

#include "compare/read/readers.hpp"
#include "compare/study/baseline_check.hpp"
#include "particle/support/json.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

const Provenance someone{"Ada", "2026-01-01T00:00:00Z", "0.1.0", "abc", "GNU 12", "x86", "first"};

/// A run of a surge at constant speed 2.2 m/s, written and read back. L = 0.145 m, the far wall at
/// 4 L: the front is within 0.1 L of it at (3.9 - 1) 0.145 / 2.2 = 0.191136 s.
class BaselineOfARun : public ::testing::Test {
 protected:
  void SetUp() override { write(2.2, testing::dam_break_manifest()); }

  void write(double speed, const nlohmann::json& manifest, double late = 0.0) {
    std::vector<double> times;
    for (int i = 0; i <= 25; ++i) times.push_back(0.01 * i);
    testing::write_run(
        folder_ / "run", times, [=](double t) { return 0.145 + speed * std::max(0.0, t - late); },
        manifest);
  }

  [[nodiscard]] ObservedRun run(const std::vector<std::string>& observables = {"front"}) const {
    return observe(open_run(folder_ / "run"), FrontOptions{}, observables);
  }

  [[nodiscard]] Baseline blessed(const BlessOptions& options = {},
                                 const std::vector<std::string>& observables = {"front"}) const {
    ObservedRun source = run(observables);
    return bless(source, options, someone);
  }

  static Finding find(const CheckResult& checked, const std::string& quantity) {
    for (const Finding& f : checked.findings)
      if (f.quantity == quantity) return f;
    ADD_FAILURE() << quantity << " not found";
    return {};
  }

  TemporaryFolder folder_;
};

TEST_F(BaselineOfARun, PassesAfterAWayThroughItsFile) {
  write_baseline(folder_ / "b.json", blessed());
  const Baseline baseline = read_baseline(folder_ / "b.json");
  EXPECT_EQ(baseline.measured.by, "Ada");
  EXPECT_EQ(baseline.measured.reason, "first");
  EXPECT_EQ(baseline.observables(), std::vector<std::string>{"front"});
  ASSERT_EQ(baseline.curves.size(), 1U);
  EXPECT_EQ(baseline.curves[0].at.size(), 20U);
  EXPECT_NEAR(baseline.curves[0].tolerance.absolute, 0.02 * 0.145, 1e-12);
  const CheckResult checked = check(run(), baseline);
  EXPECT_EQ(checked.failed(), 0U);
  for (const char* quantity : {"front", "method", "preset", "dimension", "impact_time_s",
                               "lost_particles", "nonfinite", "finished", "spacing_m"})
    EXPECT_EQ(find(checked, quantity).status, Status::passed) << quantity;
}

TEST_F(BaselineOfARun, WindowEndsNearTheFarWallAndSaysSo) {
  const Baseline baseline = blessed();
  EXPECT_EQ(baseline.from, 0.0);
  EXPECT_NEAR(baseline.until, 2.9 * 0.145 / 2.2, 1e-5);
  EXPECT_THAT(baseline.because, HasSubstr("within 0.1 L of the far wall"));
  EXPECT_LE(baseline.curves[0].at.back(), baseline.until);
}

TEST_F(BaselineOfARun, WindowMayBeStatedButNotBeyondTheFrames) {
  BlessOptions options;
  options.until = Seconds(0.1);
  options.because = "a splash";
  const Baseline baseline = blessed(options);
  EXPECT_EQ(baseline.until, 0.1);
  EXPECT_EQ(baseline.because, "a splash");
  EXPECT_EQ(baseline.curves[0].at.back(), 0.1);
  EXPECT_FALSE(baseline.values.contains("impact_time_s"));
  options.until = Seconds(0.3);
  EXPECT_THAT(error_of([&] { (void)blessed(options); }), HasSubstr("--until: found 0.3"));
}

TEST_F(BaselineOfARun, FailsAtItsWorstPointWhenTheFrontIsFaster) {
  const Baseline baseline = blessed();
  write(2.4, testing::dam_break_manifest());
  const CheckResult checked = check(run(), baseline);
  const Finding front = find(checked, "front");
  EXPECT_EQ(front.status, Status::failed);
  EXPECT_EQ(front.worst, "0.19 s");
  EXPECT_NEAR(front.deviation, 0.2 * 0.19, 1e-6);
  EXPECT_EQ(find(checked, "impact_time_s").status, Status::failed);
  EXPECT_EQ(find(checked, "lost_particles").status, Status::passed);
  ASSERT_EQ(checked.curves.size(), 1U);
  EXPECT_EQ(checked.curves[0].worst, 0.19);
  EXPECT_EQ(checked.curves[0].at.size(), 20U);  // of the window only
}

TEST_F(BaselineOfARun, CurveMayBeLateByItsToleranceInTime) {
  BlessOptions options;
  options.absolute = {{"front", 1e-4}};
  options.time = {{"front", 0.012}};
  const Baseline baseline = blessed(options);
  write(2.2, testing::dam_break_manifest(), 0.01);
  const CheckResult late = check(run(), baseline);
  EXPECT_EQ(find(late, "front").status, Status::passed);
  EXPECT_NEAR(find(late, "front").deviation, 0.0, 1e-12);
  write(2.2, testing::dam_break_manifest(), 0.02);
  const Finding later = find(check(run(), baseline), "front");
  EXPECT_EQ(later.status, Status::failed);
  EXPECT_NEAR(later.deviation, -2.2 * 0.008, 1e-6);
}

TEST_F(BaselineOfARun, LargerOfAbsoluteAndRelativeToleranceHolds) {
  const Tolerance both{0.1, 0.02, 0.0};
  EXPECT_EQ(both.of(1.0), 0.1);
  EXPECT_EQ(both.of(-10.0), 0.2);
}

TEST_F(BaselineOfARun, FailsWhereTheRunEndsEarly) {
  const Baseline baseline = blessed();
  testing::write_run(folder_ / "run", {0.0, 0.01, 0.02, 0.03},
                     [](double t) { return 0.145 + 2.2 * t; });
  const CheckResult checked = check(run(), baseline);
  EXPECT_EQ(find(checked, "front").found, "missing");
  EXPECT_EQ(find(checked, "front").status, Status::failed);
  EXPECT_THAT(find(checked, "front").why, HasSubstr("from 0 to 0.03 s only"));
  EXPECT_EQ(find(checked, "impact_time_s").found, "missing");
}

TEST_F(BaselineOfARun, FailsWhereFramesInBetweenAreMissing) {
  const Baseline baseline = blessed();
  testing::write_run(folder_ / "run", {0.0, 0.01, 0.02, 0.05, 0.06, 0.2, 0.25},
                     [](double t) { return 0.145 + 2.2 * t; });
  const Finding front = find(check(run(), baseline), "front");
  EXPECT_EQ(front.found, "missing");
  EXPECT_THAT(front.why, HasSubstr("found nothing between 0.02 and 0.05 s"));
}

TEST_F(BaselineOfARun, FailsOnCountsOnMissingAndOnNotFiniteValues) {
  const Baseline baseline = blessed();
  nlohmann::json manifest = testing::dam_break_manifest();
  manifest["lost_particles"] = 1;
  manifest.erase("nonfinite");
  manifest["case"]["method"]["preset"] = "other";
  write(2.2, manifest);
  const CheckResult checked = check(run(), baseline);
  EXPECT_EQ(find(checked, "lost_particles").status, Status::failed);
  EXPECT_EQ(find(checked, "nonfinite").found, "missing");
  EXPECT_EQ(find(checked, "preset").status, Status::failed);
  EXPECT_EQ(checked.failed(), 3U);

  ObservedRun broken = run();
  broken.found[0].series[0].values[3] = std::nan("");
  EXPECT_EQ(find(check(broken, baseline), "front").status, Status::failed);
  broken.found[0].series[0].unit = "mm";
  EXPECT_THAT(find(check(broken, baseline), "front").why, HasSubstr("found the unit mm"));
  broken.found[0].failure = "no water";
  EXPECT_EQ(find(check(broken, baseline), "front").why, "no water");
  broken.observables[0] = "volume";
  EXPECT_EQ(find(check(broken, baseline), "front").status, Status::failed);
}

TEST_F(BaselineOfARun, ToleranceIsTheLimit) {
  Baseline baseline = blessed();
  for (double& value : baseline.curves[0].values) value += 0.0199 * 0.145;
  EXPECT_EQ(find(check(run(), baseline), "front").status, Status::passed);
  for (double& value : baseline.curves[0].values) value += 0.0002 * 0.145;
  EXPECT_EQ(find(check(run(), baseline), "front").status, Status::failed);
}

TEST_F(BaselineOfARun, HoldsAnyObservablesEachWithItsTolerance) {
  BlessOptions options;
  options.absolute = {{"", 0.001}, {"gauge:x=0.2", 0.0005}};
  options.relative = {{"centre-of-mass.x", 0.1}};
  const Baseline baseline =
      blessed(options, {"gauge:x=0.2", "centre-of-mass", "profile:times=0.05;0.1"});
  std::map<std::string, const BaselineCurve*> by_name;
  for (const BaselineCurve& curve : baseline.curves) by_name[curve.name()] = &curve;
  ASSERT_TRUE(by_name.contains("gauge:x=0.2"));
  EXPECT_EQ(by_name["gauge:x=0.2"]->tolerance.absolute, 0.0005);
  ASSERT_TRUE(by_name.contains("centre-of-mass.x"));
  EXPECT_EQ(by_name["centre-of-mass.x"]->tolerance.relative, 0.1);
  ASSERT_TRUE(by_name.contains("profile:times=0.05;0.1 at 0.05 s"));
  ASSERT_TRUE(by_name.contains("profile:times=0.05;0.1 at 0.1 s"));
  write_baseline(folder_ / "b.json", baseline);
  const Baseline again = read_baseline(folder_ / "b.json");
  EXPECT_EQ(check(run(again.observables()), again).failed(), 0U);
  write(3.0, testing::dam_break_manifest());
  const CheckResult checked = check(run(again.observables()), again);
  EXPECT_EQ(find(checked, "gauge:x=0.2").status, Status::failed);
  EXPECT_EQ(find(checked, "profile:times=0.05;0.1 at 0.1 s").status, Status::failed);
}

TEST_F(BaselineOfARun, ToleranceOfNothingAndCurveOfZerosAreRefused) {
  BlessOptions options;
  options.absolute = {{"gauge", 0.01}};
  EXPECT_THAT(error_of([&] { (void)blessed(options); }), HasSubstr("found no such result"));
  EXPECT_THAT(error_of([&] {
                (void)blessed({}, {"front", "gauge:x=0.57"});
              }),
              HasSubstr("all values are 0"));
}

TEST_F(BaselineOfARun, IsNotMadeOfAnUnfinishedRun) {
  nlohmann::json manifest = testing::dam_break_manifest();
  manifest["finished"] = false;
  write(2.2, manifest);
  EXPECT_THAT(error_of([&] { (void)blessed(); }), HasSubstr("not finished"));
}

TEST_F(BaselineOfARun, FileThatIsNotCompleteIsRefused) {
  write_baseline(folder_ / "b.json", blessed());
  const nlohmann::json good = read_json(folder_ / "b.json");
  const auto refused = [&](const std::string& patch) {
    nlohmann::json bad = good.patch(nlohmann::json::parse("[" + patch + "]"));
    testing::write_text(folder_ / "bad.json", bad.dump());
    return error_of([&] { (void)read_baseline(folder_ / "bad.json"); });
  };
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/curves/0/tolerance/absolute", "value": 9})"),
              HasSubstr("--bless --reason is the way to change one"));
  EXPECT_THAT(refused(R"({"op": "add", "path": "/colour", "value": 1})"), HasSubstr("checksum"));
  EXPECT_THAT(refused(R"({"op": "remove", "path": "/checksum"})"),
              HasSubstr("checksum: nothing found"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/format", "value": 1})"),
              HasSubstr("one of another version"));
  testing::write_text(folder_ / "bad.json", "{");
  EXPECT_THAT(error_of([&] { (void)read_baseline(folder_ / "bad.json"); }), HasSubstr("not JSON"));
  Baseline empty = blessed();
  empty.curves.clear();
  write_baseline(folder_ / "bad.json", empty);
  EXPECT_THAT(error_of([&] { (void)read_baseline(folder_ / "bad.json"); }),
              HasSubstr("a list of curves, one at least"));
}

TEST_F(BaselineOfARun, ManyPointsAreThinnedToEvenDistances) {
  ObservedRun source = run();
  TimeSeries& series = source.found[0].series[0];
  series.times.clear();
  series.values.clear();
  for (int i = 0; i <= 2000; ++i) {
    series.times.emplace_back(1e-4 * i);
    series.values.emplace_back(0.145 + 2.2e-4 * i);
  }
  const Baseline baseline = bless(source, {}, someone);
  EXPECT_EQ(baseline.curves[0].at.size(), 500U);
  EXPECT_EQ(check(source, baseline).failed(), 0U);
}

TEST(Provenance, NeedsAReason) {
  EXPECT_THAT(error_of([] { (void)provenance_now("  "); }), HasSubstr("--reason"));
  const Provenance now = provenance_now("because");
  EXPECT_FALSE(now.by.empty());
  EXPECT_FALSE(now.version.empty());
  EXPECT_EQ(now.date.size(), 20U);
}

}  // namespace
}  // namespace surge::compare
