#include "compare/report/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/report/errata.hpp"
#include "compare/report/report.hpp"
#include "synthetic_study.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using testing::read_text;
using testing::SyntheticStudy;

json claim(const json& metrics, const std::string& id) {
  for (const json& entry : metrics["claims"]) {
    if (entry["id"] == id) return entry;
  }
  ADD_FAILURE() << "no claim " << id;
  return {};
}

TEST(Claims, FollowTheFronts) {
  const SyntheticStudy files;
  const json metrics = report_metrics(files.collected());
  EXPECT_EQ(claim(metrics, "leading_edge_mps")["verdict"], "reproduced");
  EXPECT_EQ(claim(metrics, "mps_more_accurate")["verdict"], "reproduced");
  EXPECT_NEAR(claim(metrics, "leading_edge_mps")["evidence"][0]["value"], 0.02, 1e-3);
}

TEST(Claims, TurnWithTheNumbers) {
  const SyntheticStudy files;
  files.write("mps-a", "mps", 0.2 * SyntheticStudy::length);
  const json metrics = report_metrics(files.collected());
  EXPECT_EQ(claim(metrics, "leading_edge_mps")["verdict"], "not reproduced");
  EXPECT_EQ(claim(metrics, "mps_more_accurate")["verdict"], "not reproduced");
}

TEST(Claims, SeveralRunsOfAMethodMayDisagree) {
  const SyntheticStudy files;
  std::string study = read_text(files.study());
  study += "[[run]]\nname = \"mps-b\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\n";
  testing::write_text(files.study(), study);
  files.write("mps-b", "mps", 0.2 * SyntheticStudy::length);
  const json metrics = report_metrics(files.collected());
  EXPECT_THAT(claim(metrics, "leading_edge_mps")["verdict"].get<std::string>(),
              HasSubstr("depends on"));
  EXPECT_THAT(claim(metrics, "mps_more_accurate")["verdict"].get<std::string>(),
              HasSubstr("depends on"));
}

TEST(Claims, WithoutRunsNothingIsSaid) {
  const SyntheticStudy files;
  std::filesystem::remove_all(files.runs() / "sph-a");
  const json metrics = report_metrics(files.collected());
  EXPECT_EQ(claim(metrics, "leading_edge_sph")["verdict"], "not measured");
  EXPECT_EQ(claim(metrics, "mps_more_accurate")["verdict"], "not measured");
  EXPECT_EQ(claim(metrics, "sph_cheaper")["verdict"], "not measured");
}

TEST(Claims, CostLeavesSetupAndOutputOut) {
  const SyntheticStudy files;
  const auto file = files.runs() / "mps-a/manifest.json";
  json manifest = json::parse(read_text(file));
  manifest["wall_s"] = {{"total", 12.0},   {"setup", 1.0},      {"output", 1.0},
                        {"pressure", 8.0}, {"neighbours", 1.0}, {"forces", 1.0}};
  manifest["steps"] = 1000;
  manifest["simulated_s"] = 0.5;
  testing::write_text(file, manifest.dump());
  const json metrics = report_metrics(files.collected());
  EXPECT_DOUBLE_EQ(metrics["cost"]["mps-a"]["ms_per_step"], 10.0);
  EXPECT_DOUBLE_EQ(metrics["cost"]["mps-a"]["s_per_simulated_s"], 20.0);
  EXPECT_DOUBLE_EQ(metrics["cost"]["mps-a"]["share"]["pressure"], 0.8);
  EXPECT_EQ(claim(metrics, "poisson_dominates")["verdict"], "reproduced");
}

TEST(Scaling, FitsTheTimedRunsAndKeepsThemOutOfEverythingElse) {
  const SyntheticStudy files;
  std::string study = read_text(files.study());
  for (const int n : {10, 20, 40, 80}) {
    const std::string name = "time-" + std::to_string(n);
    study +=
        "[[run]]\nname = \"" + name +
        "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nrole = \"timing\"\nrepeats = 3\n";
    for (const char* repeat : {"", "-repeat2", "-repeat3"}) {
      json manifest = testing::dam_break_manifest();
      const double all = 2.0 * n * n;
      // A square law; one of the three repeats was disturbed.
      const double ms = 1e-4 * all * all * (std::string(repeat) == "-repeat2" ? 5.0 : 1.0);
      manifest["fluid_particles"] = n * n;
      manifest["wall_particles"] = n * n;
      manifest["steps"] = 50;
      manifest["simulated_s"] = 0.05;
      manifest["case"]["spacing"] = 0.2 / n;
      manifest["case"]["method"] = {{"name", "mps"}, {"preset", "paper"}};
      manifest["case"]["search"] = {{"neighbours", "all_pairs"}};
      manifest["wall_s"] = {
          {"total", 0.05 * ms + 3.0}, {"setup", 1.0},           {"output", 2.0},
          {"neighbours", 0.04 * ms},  {"pressure", 0.005 * ms}, {"forces", 0.005 * ms}};
      testing::write_text(files.runs() / (name + repeat) / "manifest.json", manifest.dump());
    }
  }
  testing::write_text(files.study(), study);
  const json metrics = report_metrics(files.collected());
  const json& curve = metrics["scaling"]["mps paper all_pairs"];
  ASSERT_EQ(curve["points"].size(), 4U);
  EXPECT_EQ(curve["points"][0]["repeats"], 3);
  EXPECT_NEAR(curve["points"][0]["ms_per_step"], 1e-4 * 200.0 * 200.0, 1e-9);
  EXPECT_NEAR(curve["fit_per_step"]["exponent"], 2.0, 1e-6);
  EXPECT_NEAR(curve["points"][1]["share"]["neighbours"], 0.8, 1e-6);
  EXPECT_TRUE(curve["points"][0]["extrapolated"]);
  // mps-a: 1200 steps at 5 mm for one second.
  EXPECT_NEAR(curve["points"][1]["total_s"], 1e-3 * 64.0 * 1200 * 0.005 / 0.01, 1e-6);
  EXPECT_EQ(claim(metrics, "grows_quadratically")["verdict"], "reproduced");
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

TEST(Errata, EachIsHeldByATestThatExists) {
  for (const Erratum& erratum : errata()) {
    const std::string source = read_text(std::string(SURGE_SOURCE_DIR) + "/" + erratum.test_file);
    const std::string test = erratum.test;
    const auto dot = test.find('.');
    ASSERT_NE(dot, std::string::npos) << test;
    std::string heading = test;
    heading.replace(dot, 1, ", ");
    EXPECT_THAT(source, HasSubstr(heading + ")")) << heading;
  }
}

}  // namespace
}  // namespace surge::compare
