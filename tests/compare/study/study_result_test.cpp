#include "compare/study/study_result.hpp"

#include <gmock/gmock.h>

#include "compare/report/report.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using testing::read_text;
using testing::SyntheticStudy;

/// Adds a run in a role to the study's file.
void add_run(const SyntheticStudy& files, const std::string& name, const std::string& role) {
  const std::string more =
      "[[run]]\nname = \"" + name +
      "\"\nprogram = \"surge-particle\"\ncase = \"c.toml\"\nset = []\nrole = \"" + role +
      "\"\ngroup = \"beta\"\n";
  testing::write_text(files.study(), read_text(files.study()) + more);
}

TEST(StudyResult, RunsAreFoundByTheirRole) {
  const SyntheticStudy files;
  files.write("beta-0.95", "mps", 0.1 * SyntheticStudy::length);
  files.write("still", "sph", 0.0, false);
  files.write("fast", "sph", 0.0);
  add_run(files, "beta-0.95", "sensitivity");
  add_run(files, "beta-0.99", "sensitivity");
  add_run(files, "still", "verification");
  add_run(files, "fast", "timing");
  const StudyResult study = files.collected();

  EXPECT_EQ(study.runs_of(Role::comparison).size(), 3U);
  const auto varied = study.runs_of(Role::sensitivity);
  ASSERT_EQ(varied.size(), 2U);
  EXPECT_EQ(varied[0]->study.group, "beta");
  EXPECT_EQ(varied[0]->status, RunStatus::complete);
  ASSERT_NE(varied[0]->measured, nullptr);
  EXPECT_EQ(varied[1]->status, RunStatus::missing);
  EXPECT_EQ(varied[1]->measured, nullptr);

  const auto verified = study.runs_of(Role::verification);
  ASSERT_EQ(verified.size(), 1U);
  EXPECT_EQ(verified[0]->status, RunStatus::unfinished);
  EXPECT_EQ(verified[0]->measured, nullptr);
  EXPECT_EQ(verified[0]->folder, files.runs() / "still");
  EXPECT_EQ(study.runs_of(Role::timing)[0]->manifest["finished"], true);
  EXPECT_TRUE(study.runs_of(Role::convergence).empty());
}

TEST(StudyResult, OnlyRunsThatAreComparedStandAmongTheFronts) {
  const SyntheticStudy files;
  files.write("beta-0.95", "mps", 0.1 * SyntheticStudy::length);
  add_run(files, "beta-0.95", "sensitivity");
  const nlohmann::json metrics = report_metrics(files.collected());
  EXPECT_TRUE(metrics["front"].contains("mps-a"));
  EXPECT_FALSE(metrics["front"].contains("beta-0.95"));
}

TEST(StudyResult, OneRunInTwoRolesIsMeasuredOnce) {
  const SyntheticStudy files;
  add_run(files, "mps-a", "convergence");
  const StudyResult study = files.collected();
  const auto levels = study.runs_of(Role::convergence);
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels[0]->measured, study.runs[0].measured);
  EXPECT_EQ(levels[0]->status, RunStatus::complete);
}

// Another wall condition is another case, except where its effect is what is asked for.
TEST(StudyResult, AnotherWallConditionIsUsableInASensitivityStudyOnly) {
  const SyntheticStudy files;
  for (const auto* role : {"sensitivity", "convergence"}) {
    files.write(role, "vof", 0.0);
    const auto file = files.runs() / role / "manifest.json";
    nlohmann::json manifest = nlohmann::json::parse(read_text(file));
    manifest["case"]["tank"]["wall"] = "no-slip";
    testing::write_text(file, manifest.dump());
    add_run(files, role, role);
  }
  const StudyResult study = files.collected();
  EXPECT_EQ(study.runs_of(Role::sensitivity)[0]->status, RunStatus::complete);
  EXPECT_EQ(study.runs_of(Role::convergence)[0]->status, RunStatus::unusable);
  EXPECT_THAT(study.runs_of(Role::convergence)[0]->note, HasSubstr("wall"));
}

}  // namespace
}  // namespace surge::compare
