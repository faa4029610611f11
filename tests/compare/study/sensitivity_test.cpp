#include "compare/study/sensitivity.hpp"

#include <gmock/gmock.h>

#include <regex>

#include "tests/compare/written_report.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_text;
using testing::SyntheticStudy;

/// The synthetic study with a base that leads the reference by 0.02 L, a run that leads it by 0.05
/// L at three times the cost, one that broke up half-way and one that was not made.
class VariedStudy : public SyntheticStudy {
 public:
  VariedStudy() {
    add("varied-base", "base", "\"mps.beta=0.97\", \"mps.lambda=paper\"", 0.02, true, 2.0);
    add("varied-beta", "beta", "\"mps.beta=0.99\"", 0.05, true, 6.0);
    add("varied-lambda", "lambda", "\"mps.lambda=lattice\"", 0.02, false, 2.0);
    list("varied-missing", "lambda", "\"mps.lambda=analytic\"");
  }

  [[nodiscard]] json measured() const {
    json metrics;
    measure_sensitivity(collected(), metrics);
    return metrics["sensitivity"];
  }

 private:
  void list(const std::string& name, const std::string& group, const std::string& setting) const {
    testing::write_text(study(), read_text(study()) + "[[run]]\nname = \"" + name +
                                     "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nset = "
                                     "[\"method.name=mps\", " +
                                     setting + "]\nrole = \"sensitivity\"\ngroup = \"" + group +
                                     "\"\n");
  }

  void add(const std::string& name, const std::string& group, const std::string& setting,
           double lead, bool finished, double cpu) const {
    write(name, "mps", lead * length, finished);
    const auto file = runs() / name / "manifest.json";
    json manifest = json::parse(read_text(file));
    manifest["cpu_s"] = cpu;
    manifest["simulated_s"] = 0.2;
    testing::write_text(file, manifest.dump());
    list(name, group, setting);
  }
};

TEST(Sensitivity, RunsAreMeasuredAgainstTheReferenceAndTheBase) {
  const json all = VariedStudy().measured();
  ASSERT_EQ(all.size(), 1U);
  const json& mps = all["mps"];
  EXPECT_NEAR(mps["base"]["bias"], 0.02, 1e-3);
  EXPECT_NEAR(mps["base"]["cost_ratio"], 1.0, 1e-12);
  ASSERT_EQ(mps["runs"].size(), 3U);
  const json& beta = mps["runs"][0];
  EXPECT_EQ(beta["choice"], "beta");
  EXPECT_EQ(beta["value"], "0.99");
  EXPECT_EQ(beta["base_value"], "0.97");
  EXPECT_NEAR(beta["rms"], 0.05, 2e-3);
  EXPECT_NEAR(beta["bias"], 0.05, 2e-3);
  EXPECT_NEAR(beta["rms_vs_base"], 0.03, 1e-3);
  EXPECT_NEAR(beta["cost_ratio"], 3.0, 1e-12);
}

TEST(Sensitivity, BrokenAndMissingRunsAreShownAsWhatTheyAre) {
  const json runs = VariedStudy().measured()["mps"]["runs"];
  EXPECT_EQ(runs[1]["status"], "unfinished");
  EXPECT_TRUE(runs[1]["rms"].is_number());
  EXPECT_LT(runs[1]["window_end_T"].get<double>(), runs[0]["window_end_T"].get<double>());
  EXPECT_EQ(runs[2]["status"], "missing");
  EXPECT_EQ(runs[2]["value"], "analytic");
  EXPECT_TRUE(runs[2]["rms"].is_null());
  EXPECT_TRUE(runs[2]["cost_ratio"].is_null());
}

TEST(Sensitivity, TheReportShowsItAndAStudyWithoutItHasNoSuchSection) {
  const VariedStudy files;
  const std::string page = testing::written_report(files).page;
  EXPECT_THAT(page, HasSubstr("<section id=\"sensitivity\""));
  EXPECT_THAT(page, HasSubstr("data-key=\"/sensitivity/mps/runs/0/rms\""));
  EXPECT_THAT(page, HasSubstr("id=\"sensitivity_mps\""));
  EXPECT_THAT(page, Not(HasSubstr("id=\"sensitivity_vof\"")));
  const std::string csv = read_text(files.out() / "figures/sensitivity_mps.csv");
  EXPECT_TRUE(std::regex_search(csv, std::regex("\n-1\\.5,beta,0\\.99,0\\.0[45]")));
  EXPECT_THAT(testing::report_without_figures(SyntheticStudy()).page,
              Not(HasSubstr("id=\"sensitivity")));
}

TEST(Sensitivity, NoNumberOfItStandsOutsideTheMetrics) {
  std::string page = testing::report_without_figures(VariedStudy()).page;
  const auto begin = page.find("<section id=\"sensitivity\"");
  ASSERT_NE(begin, std::string::npos);
  page = page.substr(begin, page.find("</section>", begin) - begin);
  page = std::regex_replace(page, std::regex("<data [^>]*>[^<]*</data>"), "");
  page = std::regex_replace(page, std::regex("<h3>|</h3>|<[^>]*>"), " ");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(page, found, std::regex("[^\\n]{0,30}[0-9][^\\n]{0,30}")))
      << found.str();
}

}  // namespace
}  // namespace surge::compare
