#include "compare/study/cost_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/report/report.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using testing::read_text;
using testing::SyntheticStudy;

/// A manifest of a run of n x n fluid particles and as many of the wall, of an exact square law
/// over all of them.
json timed_manifest(int n, double simulated, double steps, double slower) {
  json manifest = testing::dam_break_manifest();
  const double all = 2.0 * n * n;
  const double solve = 1e-3 * steps * slower * 1e-4 * all * all;
  manifest["fluid_particles"] = n * n;
  manifest["wall_particles"] = n * n;
  manifest["steps"] = steps;
  manifest["simulated_s"] = simulated;
  manifest["cpu"] = "a processor";
  manifest["threads"] = 1;
  manifest["case"]["spacing"] = 0.2 / n;
  manifest["case"]["method"] = {
      {"name", "mps"}, {"preset", "paper"}, {"parameters", {{"ppe_solver", "iccg"}}}};
  manifest["case"]["search"] = {{"neighbours", "all_pairs"}};
  manifest["wall_s"] = {{"total", solve + 3.0},    {"setup", 1.0},
                        {"output", 2.0},           {"neighbours", 0.8 * solve},
                        {"pressure", 0.1 * solve}, {"forces", 0.1 * solve}};
  return manifest;
}

/// Four sizes timed in windows of 0.05 s, three times each, and the two smallest whole: their steps
/// take half as long again, and there are 60 per particle of the width.
class TimedStudy : public SyntheticStudy {
 public:
  TimedStudy() {
    std::string study = read_text(this->study());
    for (const int n : {10, 20, 40, 80}) {
      const std::string name = "time-" + std::to_string(n);
      study += run(name, 3);
      for (const char* repeat : {"", "-repeat2", "-repeat3"}) {
        // One of the three was disturbed.
        const double slower = std::string(repeat) == "-repeat2" ? 5.0 : 1.0;
        write_manifest(name + repeat, timed_manifest(n, 0.05, 50, slower));
      }
      if (n > 20) continue;
      study += run(name + "-whole", 1);
      write_manifest(name + "-whole", timed_manifest(n, 0.22, 60.0 * n, 1.5));
    }
    testing::write_text(this->study(), study);
  }

 private:
  static std::string run(const std::string& name, int repeats) {
    return "[[run]]\nname = \"" + name +
           "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nset = [\"name=" + name +
           "\"]\nrole = \"timing\"\nrepeats = " + std::to_string(repeats) + "\n";
  }
  void write_manifest(const std::string& name, const json& manifest) const {
    testing::write_text(runs() / name / "manifest.json", manifest.dump());
  }
};

TEST(Scaling, TimesPerStepAreThoseOfTheWindowsAndTheirMedians) {
  const json metrics = report_metrics(TimedStudy().collected());
  const json& curve = metrics["scaling"]["mps paper all_pairs iccg"];
  ASSERT_EQ(curve["points"].size(), 4U);
  EXPECT_EQ(curve["label"], "MPS, all pairs, ICCG");
  const json& first = curve["points"][0];
  EXPECT_EQ(first["window"]["repeats"], 3);
  EXPECT_NEAR(first["ms_per_step"], 1e-4 * 200.0 * 200.0, 1e-9);
  EXPECT_NEAR(first["window"]["ms_per_step_most"], 5e-4 * 200.0 * 200.0, 1e-9);
  EXPECT_NEAR(first["window"]["setup_s"], 1.0, 1e-12);
  EXPECT_NEAR(first["shares"]["neighbours"], 0.8, 1e-6);
  EXPECT_NEAR(curve["fit_per_step"]["exponent"], 2.0, 1e-6);
  // As many walls as water at every size: the same growth.
  EXPECT_NEAR(curve["fit_per_step_over_fluid"]["exponent"], 2.0, 1e-6);
}

TEST(Scaling, TotalsAreMeasuredOrElseExtrapolatedAndMarked) {
  const json metrics = report_metrics(TimedStudy().collected());
  const json& curve = metrics["scaling"]["mps paper all_pairs iccg"];
  EXPECT_NEAR(curve["whole_over_window"], 1.5, 1e-9);
  EXPECT_EQ(curve["whole_over_window_at"], 400);
  const json& measured = curve["points"][1];
  EXPECT_FALSE(measured["extrapolated"]);
  EXPECT_NEAR(measured["total_s"], 1e-3 * 1.5 * 1e-4 * 800.0 * 800.0 * 1200, 1e-9);
  const json& carried = curve["points"][3];
  EXPECT_TRUE(carried["extrapolated"]);
  EXPECT_NEAR(carried["total_s"], 1e-3 * 1.5 * 1e-4 * 12800.0 * 12800.0 * 4800, 1e-6);
}

// A time of one processor beside one of another makes no law of growth.
TEST(Scaling, ProcessorsHaveCurvesOfTheirOwn) {
  const TimedStudy files;
  for (const char* name : {"time-80", "time-80-repeat2", "time-80-repeat3"}) {
    const auto file = files.runs() / name / "manifest.json";
    json manifest = json::parse(read_text(file));
    manifest["cpu"] = "a faster one";
    testing::write_text(file, manifest.dump());
  }
  const json scaling = report_metrics(files.collected())["scaling"];
  ASSERT_EQ(scaling.size(), 2U);
  const json& slow = scaling["mps paper all_pairs iccg, a processor, 1 thread"];
  EXPECT_EQ(slow["points"].size(), 3U);
  EXPECT_EQ(slow["label"], "MPS, all pairs, ICCG, a processor, 1 thread");
  const json& fast = scaling["mps paper all_pairs iccg, a faster one, 1 thread"];
  EXPECT_EQ(fast["points"].size(), 1U);
}

TEST(Scaling, RepeatsTellTheScatterOfTheTimes) {
  const json metrics = report_metrics(TimedStudy().collected());
  const json& window = metrics["scaling"]["mps paper all_pairs iccg"]["points"][0]["window"];
  // 1, 1 and 5: standard deviation sqrt(16/3), median 1
  EXPECT_NEAR(window["scatter"], std::sqrt(16.0 / 3.0), 1e-9);
}

TEST(Scaling, WithoutAWholeRunNoTotalIsClaimed) {
  const TimedStudy files;
  for (const char* name : {"time-10-whole", "time-20-whole"})
    std::filesystem::remove_all(files.runs() / name);
  const json metrics = report_metrics(files.collected());
  for (const json& point : metrics["scaling"]["mps paper all_pairs iccg"]["points"])
    EXPECT_TRUE(point["total_s"].is_null());
}

TEST(Scaling, TimedRunsStayOutOfEverythingElse) {
  const json metrics = report_metrics(TimedStudy().collected());
  EXPECT_FALSE(metrics["runs"].contains("time-10"));
  EXPECT_FALSE(metrics["front"].contains("time-10"));
  EXPECT_EQ(metrics["summary"]["asked"], 3);
}

TEST(Scaling, UnfinishedTimedRunsDoNotCount) {
  const SyntheticStudy files;
  std::string study = read_text(files.study());
  study +=
      "[[run]]\nname = \"time-1\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\n"
      "role = \"timing\"\n";
  testing::write_text(files.study(), study);
  testing::write_text(files.runs() / "time-1/manifest.json", "{\"finished\": false}");
  EXPECT_TRUE(report_metrics(files.collected())["scaling"].empty());
}

}  // namespace
}  // namespace surge::compare
