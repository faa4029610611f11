#include "compare/study/baseline.hpp"

#include <gmock/gmock.h>

#include "compare/read/readers.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

const Provenance someone{"Ada", "2026-01-01T00:00:00Z", "0.1.0", "abc", "GNU 12", "x86", "first"};

/// A run of a surge at constant speed 2.2 m/s, written and read back.
class BaselineOfARun : public ::testing::Test {
 protected:
  void SetUp() override { write(2.2, testing::dam_break_manifest()); }

  void write(double speed, const nlohmann::json& manifest) {
    std::vector<double> times;
    for (int i = 0; i <= 25; ++i) times.push_back(0.01 * i);
    testing::write_run(
        folder_ / "run", times, [=](double t) { return 0.145 + speed * t; }, manifest);
  }

  [[nodiscard]] MeasuredRun run() const {
    return measure(open_run(folder_ / "run"), FrontOptions{});
  }

  [[nodiscard]] Baseline blessed() const {
    return bless(run(), FrontOptions{}, Tolerances{}, someone);
  }

  static long failures(const std::vector<Finding>& findings) {
    return std::count_if(findings.begin(), findings.end(),
                         [](const Finding& f) { return f.status != Status::passed; });
  }

  static Finding find(const std::vector<Finding>& findings, const std::string& quantity) {
    for (const Finding& f : findings) {
      if (f.quantity == quantity) return f;
    }
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
  EXPECT_GT(baseline.front.samples.size(), 15U);
  EXPECT_EQ(baseline.arrival.size(), arrival_levels.size());
  const std::vector<Finding> findings = check(run(), baseline);
  EXPECT_EQ(failures(findings), 0);
  for (const char* quantity : {"front Z/L", "arrival T", "method", "preset", "impact_time_s",
                               "lost_particles", "nonfinite", "finished", "spacing_m"}) {
    EXPECT_EQ(find(findings, quantity).status, Status::passed) << quantity;
  }
}

TEST_F(BaselineOfARun, FailsAtItsWorstPointWhenTheFrontIsFaster) {
  const Baseline baseline = blessed();
  write(2.4, testing::dam_break_manifest());
  const std::vector<Finding> findings = check(run(), baseline);
  const Finding front = find(findings, "front Z/L");
  EXPECT_EQ(front.status, Status::failed);
  EXPECT_EQ(front.worst, "T = 2.2");
  EXPECT_NEAR(front.deviation, 0.2 * 2.2 / 11.632298 / 0.145, 1e-4);
  EXPECT_EQ(find(findings, "arrival T").status, Status::failed);
  EXPECT_EQ(find(findings, "impact_time_s").status, Status::failed);
  EXPECT_EQ(find(findings, "lost_particles").status, Status::passed);
}

TEST_F(BaselineOfARun, FailsWhereTheRunEndsEarly) {
  const Baseline baseline = blessed();
  testing::write_run(folder_ / "run", {0.0, 0.01, 0.02, 0.03},
                     [](double t) { return 0.145 + 2.2 * t; });
  const std::vector<Finding> findings = check(run(), baseline);
  EXPECT_EQ(find(findings, "front Z/L").found, "missing");
  EXPECT_EQ(find(findings, "front Z/L").status, Status::failed);
  EXPECT_EQ(find(findings, "arrival T").found, "missing");
  EXPECT_EQ(find(findings, "impact_time_s").found, "missing");
}

TEST_F(BaselineOfARun, FailsOnCountsOnMissingAndOnNotFiniteValues) {
  const Baseline baseline = blessed();
  nlohmann::json manifest = testing::dam_break_manifest();
  manifest["lost_particles"] = 1;
  manifest["finished"] = false;
  manifest.erase("nonfinite");
  manifest["case"]["method"]["preset"] = "other";
  write(2.2, manifest);
  const std::vector<Finding> findings = check(run(), baseline);
  EXPECT_EQ(find(findings, "lost_particles").status, Status::failed);
  EXPECT_EQ(find(findings, "finished").status, Status::failed);
  EXPECT_EQ(find(findings, "nonfinite").found, "missing");
  EXPECT_EQ(find(findings, "nonfinite").status, Status::failed);
  EXPECT_EQ(find(findings, "preset").status, Status::failed);
  EXPECT_EQ(failures(findings), 4);

  MeasuredRun broken = run();
  broken.front.samples[3].position = DimensionlessLength(std::nan(""));
  EXPECT_EQ(find(check(broken, baseline), "front Z/L").status, Status::failed);
}

TEST_F(BaselineOfARun, ToleranceIsTheLimit) {
  Baseline baseline = blessed();
  for (auto& sample : baseline.front.samples) sample.position += DimensionlessLength(0.0199);
  EXPECT_EQ(find(check(run(), baseline), "front Z/L").status, Status::passed);
  for (auto& sample : baseline.front.samples) sample.position += DimensionlessLength(0.0002);
  EXPECT_EQ(find(check(run(), baseline), "front Z/L").status, Status::failed);
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
  EXPECT_THAT(refused(R"({"op": "remove", "path": "/front"})"), HasSubstr("front: nothing found"));
  EXPECT_THAT(refused(R"({"op": "remove", "path": "/measured/by"})"),
              HasSubstr("measured: by: nothing found"));
  EXPECT_THAT(refused(R"({"op": "add", "path": "/colour", "value": 1})"),
              HasSubstr("colour: an unknown key"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/front/T/3", "value": null})"),
              HasSubstr("null found"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/front/T", "value": []})"),
              HasSubstr("a list of numbers"));
  EXPECT_THAT(refused(R"({"op": "remove", "path": "/front/T/3"})"), HasSubstr("values found"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/front/tolerance_Z_over_L", "value": -1})"),
              HasSubstr("at least 0"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/scalars/nonfinite/value", "value": "0"})"),
              HasSubstr("a finite number"));
  testing::write_text(folder_ / "bad.json", "{");
  EXPECT_THAT(error_of([&] { (void)read_baseline(folder_ / "bad.json"); }), HasSubstr("not JSON"));
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
