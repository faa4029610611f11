#include "compare/study/study_check.hpp"

#include <gmock/gmock.h>

#include "compare/study/study_json.hpp"
#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::error_of;
using ::testing::HasSubstr;

const fs::path source(tests::sources());
const fs::path programs(tests::programs());

std::string head(const std::string& published = "[]") {
  return "title = \"t\"\nreference = \"ref\"\nstrip_height = 0.015\nsnapshot_times = [0.1]\n"
         "published = " +
         published + "\n";
}

std::string run(const std::string& name, const std::string& program, const std::string& path,
                const std::string& settings) {
  return "[[run]]\nname = \"" + name + "\"\nprogram = \"" + program + "\"\ncase = \"" + path +
         "\"\nset = [" + settings + "]\n";
}

std::string particles(const std::string& name, const std::string& settings) {
  return run(name, "surge-particle", (source / "particle/cases/dam_break.toml").string(), settings);
}

std::string foam(const std::string& name, const std::string& settings) {
  return run(name, "interFoam", (source / "foam_cases/damBreak2D").string(), settings);
}

Study checked(const std::string& text) {
  const testing::TemporaryFolder folder;
  Study study = read_study(testing::write_text(folder / "study.toml", text));
  check_study(study, programs, "", source / "compare/reference");
  return study;
}

std::string refusal(const std::string& text) {
  return error_of([&] { static_cast<void>(checked(text)); });
}

TEST(StudyCheck, SeriesOfAnotherCaseThanAllRunsIsRefused) {
  EXPECT_THAT(refusal(head() + particles("ref", "\"resolution.spacing=0.0145\"") +
                      "[[observable]]\nname = \"h\"\nkind = \"gauge\"\nparameters = {x = 0.3}\n"
                      "references = [\"kleefsman_2005_h1\"]\n"),
              AllOf(HasSubstr("references: found kleefsman_2005_h1, of another case"),
                    HasSubstr("expected a series of the case of one run at least")));
}

TEST(StudyCheck, EachRunIsResolvedByItsProgram) {
  const Study study =
      checked(head() + foam("ref", "\"cellsPerL=10\", \"gravity=(0 -9.81 0)\"") +
              particles("a", "\"method.name=sph\", \"resolution.spacing=0.0145\"") +
              run("b", "interFoam", (source / "particle/cases/dam_break.toml").string(),
                  "\"resolution.spacing=0.029\", \"foam.maxCo=0.4\""));
  const auto& parameters = study.runs[0].resolved.at("parameters");
  EXPECT_EQ(parameters.at("cellsPerL"), 10);
  EXPECT_EQ(parameters.at("maxCo"), 0.5);
  EXPECT_EQ(parameters.at("gravity"), nlohmann::json({0.0, -9.81, 0.0}));
  EXPECT_EQ(study.runs[1].resolved.at("case").at("spacing"), 0.0145);
  EXPECT_EQ(study.runs[1].resolved.at("case").at("method").at("name"), "sph");
  EXPECT_EQ(study.runs[1].resolved.at("size").at("fluid_particles"), 200);
  EXPECT_EQ(study.runs[2].resolved.at("case").at("spacing"), 0.029);
  EXPECT_GT(study.runs[2].resolved.at("size").at("disk_bytes"), 1e6);

  const nlohmann::json told = to_json(study);
  EXPECT_EQ(told.at("reference"), "ref");
  ASSERT_EQ(told.at("runs").size(), 3U);
  EXPECT_EQ(told.at("runs")[1].at("settings")[0], "method.name=sph");
  EXPECT_EQ(told.at("runs")[1].at("roles")[0].at("role"), "comparison");
  EXPECT_EQ(to_json(study, "a").at("runs").size(), 1U);
}

// Nothing runs for an observable that cannot be measured.
TEST(StudyCheck, ObservablesAreHeldAgainstTheCaseOfEachRun) {
  const auto study = [](const std::string& kind, const std::string& parameters) {
    return head() + particles("ref", "\"resolution.spacing=0.0145\"") +
           "[[observable]]\nname = \"o\"\nkind = \"" + kind + "\"\nparameters = {" + parameters +
           "}\n";
  };
  const auto asked = [&](const std::string& kind, const std::string& parameters) {
    return refusal(study(kind, parameters));
  };
  EXPECT_NO_THROW((void)checked(study("gauge", "x = 0.3")));
  EXPECT_NO_THROW((void)checked(study("pressure", "name = \"wall_pressure\"")));
  EXPECT_NO_THROW((void)checked(study("pressure", "x = 0.58, y = 0.0145")));
  EXPECT_NO_THROW((void)checked(study("overlap", "")));
  EXPECT_THAT(asked("gauge", "X = 0.3"), HasSubstr("observable.0: o: x: found nothing"));
  EXPECT_THAT(asked("gauge", "x = 0.3, w = 1"), HasSubstr("w: found an unknown parameter"));
  EXPECT_THAT(asked("gauge", "name = \"g\""), HasSubstr("found no \"g\" among the gauges of ref"));
  EXPECT_THAT(asked("pressure", "name = \"p\""),
              HasSubstr("found no \"p\" among the probes of ref, expected one of wall_pressure"));
  EXPECT_THAT(asked("pressure", "x = 0.58"), HasSubstr("found 1 of them, expected 2 in 2D"));
  EXPECT_THAT(asked("force", "name = \"f\""),
              HasSubstr("found no \"f\" among the forces of ref, expected a case that states it"));
}

// A level whose lattice does not hold the sizes of the case says what it changes.
TEST(StudyCheck, ALevelOfConvergenceMayChangeTheSizesThatItNames) {
  const std::string level = "role = \"convergence\"\ngroup = \"g\"\n";
  const std::string wider = "\"resolution.spacing=0.029\", \"tank.upper=[0.609, 2.32]\"";
  EXPECT_THAT(refusal(head() + particles("ref", "") + particles("a", wider) + level),
              HasSubstr("tank-width: 0.609 m in a"));
  const Study study = checked(head() + particles("ref", "") + particles("a", wider) + level +
                              "allow = [\"tank-width\"]\n");
  EXPECT_EQ(study.runs[1].allowed_differences, std::set<std::string>{"tank-width"});
  EXPECT_THAT(refusal(head() + particles("ref", "") +
                      particles("a", wider + ", \"block.0.upper=[0.145, 0.261]\"") + level +
                      "allow = [\"tank-width\"]\n"),
              HasSubstr("column-height"));
  EXPECT_THAT(
      refusal(head() + particles("ref", "") + particles("a", wider) + "allow = [\"tank-width\"]\n"),
      HasSubstr("allow: found role comparison, expected role convergence"));
  EXPECT_THAT(refusal(head() + particles("ref", "") + particles("a", wider) + level +
                      "allow = [\"width\"]\n"),
              HasSubstr("allow: found \"width\", expected names out of dimension"));
}

TEST(StudyCheck, ARunInTwoRolesStandsOnceInTheList) {
  const std::string more = "role = \"convergence\"\ngroup = \"g\"\ntimed = false\n";
  const Study study = checked(head() + particles("ref", "") + particles("ref", "") + more);
  const nlohmann::json told = to_json(study);
  ASSERT_EQ(told.at("runs").size(), 1U);
  EXPECT_EQ(told.at("runs")[0].at("roles").size(), 2U);
  EXPECT_EQ(told.at("runs")[0].at("timed"), true);
}

TEST(StudyCheck, WhatIsNotThereIsNamedWithItsLine) {
  EXPECT_THAT(refusal(head() + run("ref", "surge-particle", "no.toml", "")),
              HasSubstr("study.toml:6: run.0.case: found \"no.toml\", expected an existing case"));
  EXPECT_THAT(refusal(head() + run("ref", "interFoam", "no", "")),
              HasSubstr("study.toml:6: run.0.case: found \"no\", expected an existing OpenFOAM"));
  EXPECT_THAT(refusal(head("[\"no\"]") + particles("ref", "")),
              HasSubstr("study.toml:5: published: found \"no\", expected the name of a series"));
  EXPECT_THAT(
      refusal(head() + "[[run]]\nname = \"ref\"\nprogram = \"files\"\nsource = \"nowhere\"\n"),
      HasSubstr("run.0.source: found \"nowhere\""));
}

TEST(StudyCheck, SettingsThatAProgramDoesNotHaveAreNamed) {
  EXPECT_THAT(refusal(head() + particles("ref", "\"resolution.spacng=0.1\"")),
              AllOf(HasSubstr("study.toml:6: run.0: ref: "), HasSubstr("spacng")));
  EXPECT_THAT(refusal(head() + particles("ref", "\"method.preset=papr\"")), HasSubstr("papr"));
  EXPECT_THAT(refusal(head() + particles("ref", "\"sph.h_over_l0=1.2\"")),
              HasSubstr("found an option of sph"));
  EXPECT_THAT(refusal(head() + foam("ref", "\"cellPerL=3\"")), HasSubstr("(cellsPerL?)"));
  EXPECT_THAT(
      refusal(head() + run("ref", "interFoam", (source / "particle/cases/dam_break.toml").string(),
                           "\"resolution.spacing=0.011\"")),
      HasSubstr("run.0: ref: "));
}

TEST(StudyCheck, SettingsOfAnOpenFoamCaseAreThoseThatItsMakerHas) {
  const auto said = [](const std::string& setting) {
    return refusal(head() + run("ref", "interFoam",
                                (source / "particle/cases/dam_break.toml").string(), setting));
  };
  EXPECT_THAT(said("\"foam.cellsPerK=10\""),
              AllOf(HasSubstr("study.toml:6: run.0: ref: --foam cellsPerK=10: found no such"),
                    HasSubstr("cellsPerL")));
  EXPECT_THAT(said("\"foam.maxCo=-1\""), HasSubstr("maxCo"));
  EXPECT_THAT(said("\"foam.cellsPerL=1000000\""), HasSubstr("cells"));
}

TEST(StudyCheck, SettingsOfAnOpenFoamFolderAreLikeThoseThatTheyReplace) {
  for (const std::string wrong : {"cellsPerL=abc", "cellsPerL=-4", "endTime=nan", "maxCo=(1 2)",
                                  "gravity=(0 -9.81)", "gravity=(0 x 0)", "gravity=3"})
    EXPECT_THAT(refusal(head() + foam("ref", '"' + wrong + '"')),
                AllOf(HasSubstr("study.toml:6: run.0.set: found \"" + wrong + "\""),
                      HasSubstr("expected a value like that of the case")));
  for (const std::string right : {"cellsPerL=4", "nuWater=1e-6", "gravity=(1 -9.81 0)",
                                  "timeScheme=CrankNicolson 0.9", "momentumPredictor=yes"})
    EXPECT_NO_THROW((void)checked(head() + foam("ref", '"' + right + '"'))) << right;
}

TEST(StudyCheck, RunsThatAreComparedComputeTheSameCase) {
  const std::string other =
      particles("ref", "") + particles("moon", "\"fluid.gravity=[0, -1.62]\"");
  EXPECT_THAT(refusal(head() + other),
              AllOf(HasSubstr("study.toml:11: run.1: moon: "), HasSubstr("gravity")));
  EXPECT_NO_THROW(static_cast<void>(checked(head() + other + "role = \"timing\"\n")));
}

TEST(StudyCheck, ASnapshotAfterTheEndIsRefused) {
  EXPECT_THAT(refusal(head() + particles("ref", "\"time.end=0.05\"")),
              HasSubstr("study.toml:4: snapshot_times: found 0.1, expected times up to the end"));
  EXPECT_THAT(refusal(head() + foam("ref", "\"endTime=0.05\"")), HasSubstr("snapshot_times"));
}

TEST(StudyCheck, AProgramThatIsNotBuiltIsNamed) {
  const testing::TemporaryFolder folder;
  Study study =
      read_study(testing::write_text(folder / "study.toml", head() + particles("ref", "")));
  EXPECT_THAT(error_of([&] { check_study(study, folder.path()); }),
              HasSubstr("surge-particle: not found"));
}

// Paths are words, whatever letters they are written with.
TEST(StudyCheck, CasesLieBesideTheStudyUnderAnyName) {
  const testing::TemporaryFolder folder;
  const fs::path place = folder / "a \"b\" $(touch x); & 'ü'";
  fs::create_directories(place);
  fs::copy_file(source / "particle/cases/dam_break.toml", place / "my case.toml");
  Study study = read_study(testing::write_text(
      place / "study.toml", head() + run("ref", "surge-particle", "my case.toml", "")));
  check_study(study, programs);
  EXPECT_EQ(study.runs[0].case_file, place / "my case.toml");
  EXPECT_EQ(study.runs[0].resolved.at("case").at("spacing"), 0.005);
}

}  // namespace
}  // namespace surge::compare
