#include "compare/report/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/report/report.hpp"
#include "tests/compare/synthetic_study.hpp"
#include "tests/places.hpp"

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

/// Run mps-b, whose front leads by 0.2 L.
void add_inaccurate_mps(const SyntheticStudy& files) {
  std::string study = read_text(files.study());
  study +=
      "[[run]]\nname = \"mps-b\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nset = "
      "[\"b=1\"]\n";
  testing::write_text(files.study(), study);
  files.write("mps-b", "mps", 0.2 * SyntheticStudy::length);
  files.refine("mps-b", "mps", 0.2 * SyntheticStudy::length, "\"b=1\"");
}

TEST(Claims, FollowTheFronts) {
  const SyntheticStudy files;
  files.refine_all();
  const json metrics = report_metrics(files.collected());
  EXPECT_EQ(claim(metrics, "leading_edge_mps")["verdict"], "reproduced");
  EXPECT_EQ(claim(metrics, "mps_more_accurate")["verdict"], "reproduced");
  EXPECT_NEAR(claim(metrics, "leading_edge_mps")["evidence"][0]["value"], 0.02, 1e-3);
}

// A number without its uncertainty gets no verdict.
TEST(Claims, WithoutRefinementNothingIsDecided) {
  const SyntheticStudy files;
  const json metrics = report_metrics(files.collected());
  EXPECT_EQ(claim(metrics, "leading_edge_mps")["verdict"], "not decidable");
  EXPECT_EQ(claim(metrics, "mps_more_accurate")["verdict"], "not decidable");
  EXPECT_EQ(claim(metrics, "patterns_alike")["verdict"], "not decidable");
  EXPECT_EQ(claim(metrics, "sph_cheaper")["verdict"], "not decidable");
  EXPECT_GE(metrics["claim_counts"]["not decidable"], 5);
  EXPECT_EQ(metrics["summary"]["accuracy"], "not decidable");
}

TEST(Claims, TurnWithTheNumbers) {
  const SyntheticStudy files;
  files.refine_all(0.2);
  files.write("mps-a", "mps", 0.2 * SyntheticStudy::length);
  const json metrics = report_metrics(files.collected());
  EXPECT_EQ(claim(metrics, "leading_edge_mps")["verdict"], "not reproduced");
  EXPECT_EQ(claim(metrics, "mps_more_accurate")["verdict"], "not reproduced");
}

TEST(Claims, SeveralRunsOfAMethodMayDisagree) {
  const SyntheticStudy files;
  files.refine_all();
  add_inaccurate_mps(files);
  const json metrics = report_metrics(files.collected());
  EXPECT_THAT(claim(metrics, "leading_edge_mps")["verdict"].get<std::string>(),
              HasSubstr("depends on"));
  EXPECT_THAT(claim(metrics, "mps_more_accurate")["verdict"].get<std::string>(),
              HasSubstr("depends on"));
}

// The same run as above, but by a formulation that the paper says nothing about.
TEST(Claims, OfThePaperAreNotJudgedByNewerFormulations) {
  const SyntheticStudy files;
  files.refine_all();
  add_inaccurate_mps(files);
  const auto file = files.runs() / "mps-b/manifest.json";
  json manifest = json::parse(read_text(file));
  manifest["case"]["method"]["preset"] = "improved";
  testing::write_text(file, manifest.dump());
  const json metrics = report_metrics(files.collected());
  EXPECT_EQ(claim(metrics, "leading_edge_mps")["verdict"], "reproduced");
  EXPECT_EQ(claim(metrics, "mps_more_accurate")["verdict"], "reproduced");
  EXPECT_EQ(metrics["summary"]["methods"]["mps"]["run"], "mps-a");
  EXPECT_EQ(metrics["summary"]["beyond"]["mps"]["run"], "mps-b");
  EXPECT_TRUE(metrics["summary"]["beyond"]["sph"].is_null());
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
  EXPECT_EQ(claim(metrics, "poisson_dominates")["verdict"], "not decidable");  // timed once
}

/// The verdict on metrics that a test may have changed.
std::string verdict(const StudyResult& study, const json& metrics, const std::string& id) {
  for (const Claim& found : find_claims(study, metrics)) {
    if (found.id == id) return found.verdict;
  }
  ADD_FAILURE() << "no claim " << id;
  return {};
}

/// Metrics of the synthetic study, of which tests change the numbers that a verdict rests on.
class Verdicts : public ::testing::Test {
 protected:
  [[nodiscard]] std::string of(const std::string& id) const {
    return verdict(study_, metrics_, id);
  }
  json& number(const std::string& pointer) { return metrics_[json::json_pointer(pointer)]; }
  /// Repeats what the test did to the files.
  void measure() {
    study_ = files_.collected();
    metrics_ = report_metrics(study_);
  }
  void change_manifest(const std::string& run, const std::string& pointer, const json& value) {
    const auto file = files_.runs() / run / "manifest.json";
    json manifest = json::parse(read_text(file));
    manifest[json::json_pointer(pointer)] = value;
    testing::write_text(file, manifest.dump());
  }

  void time_twice(double scatter) {
    number("/scaling/timed") = {{"method", "mps"},
                                {"search", "other"},
                                {"label", "timed"},
                                {"fit_per_step", nullptr},
                                {"points", {{{"fluid_particles", 1}, {"window", {}}}}}};
    number("/scaling/timed/points/0/window") = {{"repeats", 5}, {"scatter", scatter}};
  }

  /// Of a run and of its coarser levels: refining changes nothing, the uncertainty is zero.
  void set_pattern(const std::string& run, const std::string& pointer, double value) {
    number("/patterns/" + run + pointer) = value;
    for (const char* level : {"-at-0.014500", "-at-0.029000"})
      number("/pattern_levels/" + run + level + pointer) = value;
  }

  Verdicts() {
    files_.refine_all();
    measure();
  }

  SyntheticStudy files_;
  StudyResult study_;
  json metrics_;
};

TEST_F(Verdicts, PatternsAreAlikeWhereRegionsOverlap) {
  const auto set = [&](double mps, double sph) {
    for (const char* when : {"before", "after"}) {
      set_pattern("mps-a", std::string("/overlap/") + when + "_mean", mps);
      set_pattern("sph-a", std::string("/overlap/") + when + "_mean", sph);
    }
  };
  set(0.95, 0.91);
  EXPECT_EQ(of("patterns_alike"), "reproduced");
  set(0.95, 0.89);
  EXPECT_THAT(of("patterns_alike"), HasSubstr("depends on the time and the formulation"));
  set(0.7, 0.6);
  EXPECT_EQ(of("patterns_alike"), "not reproduced");
  number("/pattern_levels/mps-a-at-0.014500/overlap/after_mean") = 0.9;  // refining changes much
  EXPECT_EQ(of("patterns_alike"), "not decidable");
}

TEST_F(Verdicts, FragmentationIsOfMpsAlone) {
  const auto set = [&](const std::string& run, std::size_t cohesion, double part) {
    set_pattern(run, "/detached/" + std::to_string(cohesion) + "/part_mean", part);
  };
  for (std::size_t c = 0; c < cohesion_count; ++c) {
    set("mps-a", c, 0.01);
    set("sph-a", c, 0.0);
    set("vof-20", c, 0.001);
  }
  EXPECT_EQ(of("only_mps_fragments"), "reproduced");
  set("vof-20", 0, 0.01);
  EXPECT_THAT(of("only_mps_fragments"), HasSubstr("depends on how strictly"));
  for (std::size_t c = 0; c < cohesion_count; ++c) set("sph-a", c, 0.02);
  EXPECT_EQ(of("only_mps_fragments"), "not reproduced");
  for (std::size_t c = 0; c < cohesion_count; ++c) set("sph-a", c, 0.0);
  set("vof-20", 0, 0.001);
  EXPECT_EQ(of("only_mps_fragments"), "reproduced");
  number("/pattern_levels/vof-20-at-0.014500").clear();
  EXPECT_EQ(of("only_mps_fragments"), "not decidable");
}

TEST_F(Verdicts, CostSaysInWhichQuantityTheClaimFails) {
  const auto set = [&](const char* run, double step, double second) {
    number(std::string("/cost/") + run + "/ms_per_step") = step;
    number(std::string("/cost/") + run + "/s_per_simulated_s") = second;
  };
  set("mps-a", 2.0, 20.0);
  set("sph-a", 1.0, 10.0);
  EXPECT_EQ(of("sph_cheaper"), "not decidable");  // nothing was timed twice
  time_twice(0.5);
  EXPECT_EQ(of("sph_cheaper"), "not decidable");
  time_twice(0.05);
  EXPECT_EQ(of("sph_cheaper"), "reproduced");
  set("sph-a", 1.0, 30.0);
  EXPECT_EQ(of("sph_cheaper"),
            "depends on the quantity: not so per simulated second with the paper’s step rule");
  set("sph-a", 3.0, 30.0);
  EXPECT_EQ(of("sph_cheaper"), "not reproduced");
  change_manifest("sph-a", "/case/method/parameters/acoustic_courant", 0.25);
  measure();
  time_twice(0.05);
  set("mps-a", 2.0, 20.0);
  set("sph-a", 1.0, 30.0);
  EXPECT_EQ(of("sph_cheaper"),
            "depends on the quantity: not so per simulated second with an acoustic limit of the "
            "step");
}

/// Curves of both methods with one point each.
json curves(double mps_ms, double sph_ms, double mps_exponent, double sph_exponent,
            double half_width = 0.02) {
  const auto curve = [&](const char* method, double ms, double exponent) {
    return json{{"method", method},
                {"search", "all_pairs"},
                {"label", method},
                {"fit_per_step", {{"exponent", exponent}, {"half_width", half_width}}},
                {"points",
                 {{{"fluid_particles", 5000},
                   {"ms_per_step", ms},
                   {"total_s", nullptr},
                   {"window", {{"repeats", 4}, {"scatter", 0.01}}}}}}};
  };
  return {{"a", curve("mps", mps_ms, mps_exponent)}, {"b", curve("sph", sph_ms, sph_exponent)}};
}

TEST_F(Verdicts, TimedRunsCountForTheCostToo) {
  number("/cost/mps-a") = {{"ms_per_step", 2.0}, {"s_per_simulated_s", 20.0}};
  number("/cost/sph-a") = {{"ms_per_step", 1.0}, {"s_per_simulated_s", 10.0}};
  number("/scaling") = curves(9.0, 8.0, 2.0, 2.0);
  EXPECT_EQ(of("sph_cheaper"), "reproduced");
  number("/scaling") = curves(9.0, 10.0, 2.0, 2.0);
  EXPECT_EQ(of("sph_cheaper"),
            "depends on the quantity: not so per step at 5000 particles with the search all_pairs");
}

TEST_F(Verdicts, GrowthNeedsBothMethods) {
  number("/scaling") = curves(1.0, 1.0, 1.9, 2.1);
  EXPECT_EQ(of("grows_quadratically"), "reproduced");
  number("/scaling") = curves(1.0, 1.0, 1.9, 1.8);
  EXPECT_EQ(of("grows_quadratically"), "depends on the method");
  number("/scaling") = curves(1.0, 1.0, 1.2, 1.8);
  EXPECT_EQ(of("grows_quadratically"), "not reproduced");
  number("/scaling") = curves(1.0, 1.0, 1.9, 2.1, 0.1);
  EXPECT_EQ(of("grows_quadratically"), "not decidable");
  number("/scaling").erase("b");
  EXPECT_EQ(of("grows_quadratically"), "not measured");
}

TEST_F(Verdicts, ThePressureTakesMostOfTheTime) {
  number("/cost/mps-a/share/pressure") = 0.6;
  EXPECT_EQ(of("poisson_dominates"), "not decidable");
  time_twice(0.05);
  EXPECT_EQ(of("poisson_dominates"), "reproduced");
  number("/cost/mps-a/share/pressure") = 0.4;
  EXPECT_EQ(of("poisson_dominates"), "not reproduced");
}

TEST_F(Verdicts, ClusteringIsJudgedWithoutCollisions) {
  const auto apart = [&](double mps, double sph) {
    set_pattern("mps-a", "/smallest_distance_over_l0/median", mps);
    set_pattern("sph-a", "/smallest_distance_over_l0/median", sph);
  };
  apart(0.5, 0.1);
  EXPECT_THAT(of("no_clustering"), HasSubstr("no run of this study is without"));
  apart(0.1, 0.5);
  EXPECT_EQ(of("no_clustering"), "not reproduced");

  testing::write_text(files_.study(),
                      read_text(files_.study()) +
                          "[[run]]\nname = \"alone\"\nprogram = \"surge-particle\"\ncase = "
                          "\"c.toml\"\nrole = \"sensitivity\"\ngroup = \"collisions\"\n");
  files_.write("alone", "mps", 0.0);
  change_manifest("alone", "/case/method/parameters/collision_distance", 0.0);
  measure();
  // The last particle of the floor layer is moved back to the edge, so close to the one before.
  const double measured = number("/without_collisions/alone/smallest_distance_over_l0");
  EXPECT_GT(measured, 0.0);
  EXPECT_LT(measured, 1.0);
  EXPECT_NEAR(number("/without_collisions/alone/last_s"), 0.22, 1e-12);
  apart(0.5, 0.1);
  number("/without_collisions/alone/smallest_distance_over_l0") = 0.3;
  EXPECT_EQ(of("no_clustering"), "reproduced");
  number("/without_collisions/alone/smallest_distance_over_l0") = 0.2;
  EXPECT_THAT(of("no_clustering"), HasSubstr("without them they cluster"));

  std::filesystem::remove_all(files_.runs() / "alone");
  files_.write("alone", "mps", 0.0, false);  // ends early
  change_manifest("alone", "/case/method/parameters/collision_distance", 0.0);
  measure();
  apart(0.5, 0.1);
  number("/without_collisions/alone/smallest_distance_over_l0") = 0.3;
  EXPECT_THAT(of("no_clustering"), HasSubstr("without them the run breaks up"));
}

TEST_F(Verdicts, LostParticlesAndEarlyEndsAreNotRobust) {
  EXPECT_EQ(of("large_deformation"), "reproduced");
  change_manifest("mps-a", "/lost_particles", 3);
  measure();
  EXPECT_EQ(of("large_deformation"), "depends on the formulation");
  change_manifest("sph-a", "/finished", false);
  measure();
  EXPECT_EQ(of("large_deformation"), "not reproduced");
}

TEST(Errata, EachIsHeldByATestThatExists) {
  const auto folder = std::filesystem::path(tests::sources()) / "compare/studies/alves_dreux";
  for (const Erratum& erratum : read_statements(folder).errata) {
    const std::string source = read_text(tests::sources() + "/" + erratum.test_file);
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
