#include "compare/study/identity.hpp"

#include <gmock/gmock.h>

#include "compare/study/study_result.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::error_of;
using ::testing::HasSubstr;
using testing::SyntheticStudy;

/// A run as the study asks for it, and the manifest of one that was made so.
struct Pair {
  Pair() {
    manifest = testing::dam_break_manifest();
    manifest["case"]["method"]["parameters"] = {{"beta", 0.97}, {"ppe_solver", "iccg"}};
    run.program = "surge-particle";
    run.resolved = {{"case", manifest["case"]}};
  }
  [[nodiscard]] std::optional<std::string> found() const {
    return other_run(run, "nowhere", manifest);
  }
  StudyRun run;
  json manifest;
};

TEST(Identity, TheSameRunIsTheSame) {
  Pair pair;
  EXPECT_EQ(pair.found(), std::nullopt);
  pair.manifest["case"]["title"] = "another word for it";
  pair.manifest["case"]["spacing"] = 0.005 * (1 + 1e-12);
  EXPECT_EQ(pair.found(), std::nullopt);
}

TEST(Identity, AnotherRunIsToldByItsFirstDifference) {
  const std::vector<std::tuple<std::string, json, std::string>> others{
      {"/case/spacing", 0.01, "made with resolution.spacing = 0.01, the study asks for 0.005"},
      {"/case/method/parameters/beta", 0.9, "made with mps.beta = 0.9, the study asks for 0.97"},
      {"/case/method/name", "sph", "made with method.name = sph, the study asks for mps"},
      {"/case/method/preset", "bare", "made with method.preset = bare, the study asks for paper"},
      {"/case/tank/wall", "no-slip", "made with tank.wall = no-slip, the study asks for slip"},
      {"/case/blocks", json::array(), "made with blocks = [], the study asks for [{"},
      {"/case/fluid/gravity/1", -1.62,
       "made with fluid.gravity.1 = -1.62, the study asks for -9.81"},
      {"/threads", 2, "made with threads = 2, the study asks for 1"},
  };
  for (const auto& [pointer, value, expected] : others) {
    Pair pair;
    pair.manifest[json::json_pointer(pointer)] = value;
    ASSERT_TRUE(pair.found()) << pointer;
    EXPECT_THAT(*pair.found(), HasSubstr(expected));
  }
}

TEST(Identity, WithoutAResolvedStudyNothingIsSaid) {
  Pair pair;
  pair.run.resolved = nullptr;
  pair.manifest["case"]["spacing"] = 1;
  EXPECT_EQ(pair.found(), std::nullopt);
}

TEST(Identity, AFoamCaseFromAFileIsHeldToWhatBothState) {
  Pair pair;
  pair.run.program = "interFoam";
  pair.manifest["case"]["method"] = {{"name", "vof"}, {"preset", "slip"}};
  pair.manifest["case"].erase("spacing");
  EXPECT_EQ(pair.found(), std::nullopt);
  pair.manifest["case"]["tank"]["upper"][0] = 0.7;
  EXPECT_EQ(*pair.found(), "made with tank.upper.0 = 0.7, the study asks for 0.58");
}

TEST(Identity, AFoamCaseFromAFolderIsHeldToItsParameters) {
  const testing::TemporaryFolder folder;
  const std::string header = "FoamFile { version 2.0; format ascii; class dictionary; }\n";
  testing::write_text(folder / "run/system/caseParameters",
                      header + "cellsPerL 10;\nvelocityScheme linearUpwind grad(U);\nnProcs 2;\n");
  StudyRun run;
  run.program = "interFoam";
  run.resolved = {{"parameters",
                   {{"cellsPerL", parameter_value("1e1")},
                    {"velocityScheme", parameter_value("linearUpwind grad(U)")},
                    {"nProcs", 1}}}};
  EXPECT_EQ(other_run(run, folder / "run", nullptr), std::nullopt);
  run.resolved["parameters"]["cellsPerL"] = 20;
  EXPECT_EQ(other_run(run, folder / "run", nullptr),
            "made with cellsPerL = 10.0, the study asks for 20");
}

/// The synthetic study, of which a run is to be another one than its folder holds.
Study study_that_asks(const SyntheticStudy& files, const std::string& name, double spacing) {
  Study study = read_study(files.study());
  for (StudyRun& run : study.runs)
    if (run.name == name) run.resolved = {{"case", {{"spacing", spacing}}}};
  return study;
}

TEST(Identity, AnotherRunUnderANameIsUnusable) {
  const SyntheticStudy files;
  const StudyResult result =
      collect(study_that_asks(files, "mps-a", 0.01), files.runs(), files.series());
  EXPECT_EQ(result.runs[0].status, RunStatus::unusable);
  EXPECT_EQ(result.runs[0].note, "made with resolution.spacing = 0.005, the study asks for 0.01");
  EXPECT_EQ(result.runs[0].measured, nullptr);
  EXPECT_EQ(result.runs[1].status, RunStatus::complete);
  EXPECT_EQ(
      collect(study_that_asks(files, "mps-a", 0.005), files.runs(), files.series()).runs[0].status,
      RunStatus::complete);
}

TEST(Identity, AnotherRunInThePlaceOfTheReferenceIsAnError) {
  const SyntheticStudy files;
  EXPECT_THAT(error_of([&] {
                static_cast<void>(
                    collect(study_that_asks(files, "vof-20", 0.01), files.runs(), files.series()));
              }),
              HasSubstr("made with resolution.spacing = 0.005, the study asks for 0.01"));
}

}  // namespace
}  // namespace surge::compare
