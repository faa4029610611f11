#include "compare/report/viewer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/report/report.hpp"
#include "tests/compare/synthetic_study.hpp"
#include "tests/compare/viewer_reader.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using testing::read_text;
using testing::SyntheticStudy;

TEST(Viewer, PlanKeepsToItsBudgetAndToTheReference) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  const ViewerPlan whole = plan_viewer(study);
  EXPECT_EQ(whole.runs.size(), 3U);
  EXPECT_TRUE(whole.left_out.empty());
  EXPECT_EQ(whole.times.size(), 23U);  // all, the start too
  EXPECT_DOUBLE_EQ(whole.times.back().value(), 0.22);
  const ViewerPlan small = plan_viewer(study, 1.0);
  ASSERT_EQ(small.runs.size(), 1U);
  EXPECT_EQ(small.runs[0], &study.reference());
  EXPECT_EQ(small.left_out.size(), 2U);
  EXPECT_LE(small.times.size(), 3U);  // the start, and two
}

TEST(Viewer, DataOfThePageAreThoseOfTheMetricsAndOfTheRuns) {
  const SyntheticStudy files;
  const StudyResult study = files.collected();
  std::string warnings;
  const json metrics = write_report(study, files.out(), warnings);
  const std::string page = read_text(files.out() / "index.html");
  const std::string open = "id=\"viewer-data\">";
  const auto begin = page.find(open) + open.size();
  const json data = json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(data["metrics"], metrics["viewer"]);
  ASSERT_EQ(data["runs"].size(), 3U);
  const auto times = metrics["viewer"]["times_s"].size();
  for (const json& run : data["runs"]) {
    EXPECT_EQ(run["water"]["counts"].size(), times);
    EXPECT_EQ(run["surface"]["times"], times);
    // The first particle of the column, in each frame at the same place.
    const auto frames = testing::unpacked_particles(run["water"]);
    ASSERT_EQ(frames.size(), times);
    EXPECT_NEAR(frames[0][0][0], 0.0025 / 0.145, 0.005 / 0.145 / 128);
  }
  const json& front = metrics["viewer"]["Z_over_L"]["mps-a"];
  ASSERT_EQ(front.size(), times);
  EXPECT_NEAR(front[10].get<double>(), (0.145 + 2.0 * 0.1 + 0.02 * 0.145 + 0.0001) / 0.145, 1e-6);
  EXPECT_EQ(metrics["viewer"]["times_s"][0], 0.0);
  EXPECT_EQ(metrics["viewer"]["frames_of_the_runs"], times);
}

TEST(Viewer, RunThatEndedEarlyHasNoWaterAfterwards) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "sph-a");
  files.write("sph-a", "sph", 0.0, false);
  const json metrics = report_metrics(files.collected());
  const json& front = metrics["viewer"]["Z_over_L"]["sph-a"];
  EXPECT_TRUE(front[10].is_number());
  EXPECT_TRUE(front[11].is_null());
}

}  // namespace
}  // namespace surge::compare
