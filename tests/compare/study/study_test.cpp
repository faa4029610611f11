#include "compare/study/study.hpp"

#include <gmock/gmock.h>

#include <utility>

#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;

/// A run of surge-particle, and what else its table says.
std::string particle_run(const std::string& name, const std::string& more) {
  return "[[run]]\nname = \"" + name +
         "\"\nprogram = \"surge-particle\"\ncase = \"particle/cases/dam_break.toml\"\n" + more;
}

/// The VOF run of `good`, and what else its table says.
std::string vof_run(const std::string& more = "") {
  return "[[run]]\nname = \"vof-20\"\nprogram = \"interFoam\"\ncase = \"foam_cases/damBreak2D\"\n" +
         more;
}

/// What its MPS run is made with.
const std::string mps_choices =
    "set = [\"method.name=mps\", \"resolution.spacing=0.005\"]\nthreads = 2\n";

const std::string good = R"(title = "Dam break"
reference = "vof-20"
strip_height = 0.015
snapshot_times = [0.1, 0.2]
published = ["martin_moyce_1952_2.25in"]

)" + particle_run("mps-paper-0.005", mps_choices) +
                         "\n" + vof_run();

Study read(std::string text, const std::string& what = "", const std::string& with = "") {
  const testing::TemporaryFolder folder;
  if (!what.empty()) text.replace(text.find(what), what.size(), with);
  return read_study(testing::write_text(folder / "study.toml", text));
}

TEST(Study, IsRead) {
  const Study study = read(good);
  EXPECT_EQ(study.title, "Dam break");
  EXPECT_EQ(study.reference, "vof-20");
  EXPECT_EQ(study.strip_height, Metres(0.015));
  EXPECT_EQ(study.snapshot_times, (std::vector{Seconds(0.1), Seconds(0.2)}));
  ASSERT_EQ(study.runs.size(), 2U);
  EXPECT_EQ(study.runs[0].settings.size(), 2U);
  EXPECT_EQ(study.runs[0].threads, 2);
  EXPECT_EQ(study.runs[1].program, "interFoam");
  EXPECT_EQ(study.runs[1].threads, 1);
}

TEST(Study, BadEntriesAreNamedWithTheirLine) {
  const auto refused = [](const std::string& what, const std::string& with) {
    return error_of([&] { (void)read(good, what, with); });
  };
  EXPECT_THAT(refused("strip_height = 0.015", "strip_height = -1.0"),
              HasSubstr("study.toml:3: strip_height"));
  EXPECT_THAT(refused("strip_height = 0.015\n", ""), HasSubstr("strip_height"));
  EXPECT_THAT(refused("title", "titel = \"\"\ntitle"), HasSubstr("titel"));
  EXPECT_THAT(refused("\"vof-20\"\nstrip", "\"vof-40\"\nstrip"),
              HasSubstr("study.toml:2: reference"));
  EXPECT_THAT(refused("\"interFoam\"", "\"fluent\""), HasSubstr("program"));
  EXPECT_THAT(refused("[0.1, 0.2]", "[0.2, 0.1]"), HasSubstr("snapshot_times"));
  EXPECT_THAT(refused("name = \"vof-20\"", "name = \"mps-paper-0.005\""),
              HasSubstr("study.toml:15: run.1.name: found \"mps-paper-0.005\" a second time"));
  EXPECT_THAT(refused("\"mps-paper-0.005\"", "\"../mps\""), HasSubstr("name"));
  EXPECT_THAT(refused("\"method.name=mps\"", "\"method.name\""), HasSubstr("key=value"));
  EXPECT_THAT(refused("threads = 2", "threads = 0"), HasSubstr("threads"));
  EXPECT_THAT(refused("threads = 2", "thread = 2"), HasSubstr("thread"));
  EXPECT_THAT(refused("threads = 2", "role = \"tming\""), HasSubstr("role"));
  EXPECT_THAT(refused("threads = 2", "timing = true"), HasSubstr("timing"));
  EXPECT_THAT(
      refused("threads = 2", "role = \"sensitivity\""),
      HasSubstr("group: found nothing, expected what a run of role sensitivity belongs to"));
  EXPECT_THAT(refused("title", "include = [\"none.toml\"]\ntitle"),
              HasSubstr("study.toml:1: include: found \"none.toml\""));
}

TEST(Study, RunsHaveRolesAndGroups) {
  const Study study = read(good, "threads = 2", "role = \"convergence\"\ngroup = \"mps\"");
  EXPECT_EQ(study.runs[0].role, Role::convergence);
  EXPECT_EQ(study.runs[0].group, "mps");
  EXPECT_EQ(study.runs[1].role, Role::comparison);
  EXPECT_EQ(role_text(Role::verification), "verification");
}

TEST(Study, TheReferenceIsOneOfTheRunsThatAreCompared) {
  EXPECT_THAT(error_of([] {
                (void)read(good, "foam_cases/damBreak2D\"",
                           "foam_cases/damBreak2D\"\nrole = \"timing\"");
              }),
              HasSubstr("study.toml:2: reference: found \"vof-20\""));
}

TEST(Study, ThoseOfThisRepositoryAreRead) {
  const std::filesystem::path folder = tests::sources() + "/compare/studies";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_NO_THROW((void)read_study(entry.path())) << entry.path();
  }
}

/// A folder with `good` as base.toml and a study that includes it.
class IncludingStudy : public ::testing::Test {
 protected:
  Study read_with(const std::string& text) {
    testing::write_text(folder_ / "parts/base.toml", good);
    return read_study(testing::write_text(folder_ / "study.toml", text));
  }
  testing::TemporaryFolder folder_;
};

TEST_F(IncludingStudy, HasTheRunsOfBothAndTheOthersHeadWhereItHasNone) {
  const Study study =
      read_with("title = \"More\"\ninclude = [\"parts/base.toml\"]\n" +
                particle_run("coarse", "role = \"sensitivity\"\ngroup = \"spacing\"\n"));
  EXPECT_EQ(study.title, "More");
  EXPECT_EQ(study.reference, "vof-20");
  EXPECT_EQ(study.strip_height, Metres(0.015));
  ASSERT_EQ(study.runs.size(), 3U);
  EXPECT_EQ(study.runs[0].name, "mps-paper-0.005");
  EXPECT_EQ(study.runs[2].name, "coarse");
}

TEST_F(IncludingStudy, OneRunMayHaveSeveralRoles) {
  const Study study = read_with(
      "include = [\"parts/base.toml\", \"parts/../parts/base.toml\"]\n" +
      particle_run("mps-paper-0.005", mps_choices + "role = \"convergence\"\ngroup = \"mps\"\n") +
      vof_run());
  ASSERT_EQ(study.runs.size(), 3U);
  EXPECT_EQ(std::pair(study.runs[0].name, study.runs[0].role),
            std::pair(std::string("mps-paper-0.005"), Role::comparison));
  EXPECT_EQ(std::pair(study.runs[2].name, study.runs[2].role),
            std::pair(std::string("mps-paper-0.005"), Role::convergence));
}

TEST_F(IncludingStudy, OneNameForTwoComputationsIsAnError) {
  const std::string error = error_of([&] {
    (void)read_with("include = [\"parts/base.toml\"]\n" + vof_run("set = [\"cellsPerL=40\"]\n"));
  });
  EXPECT_THAT(error, HasSubstr("study.toml:3: run.0.name: found \"vof-20\" a second time"));
}

TEST_F(IncludingStudy, MistakesAreToldWithTheIncludedFile) {
  testing::write_text(folder_ / "parts/wrong.toml", "[[run]]\nname = \"a\"\nprogram = \"b\"\n");
  EXPECT_THAT(error_of([&] { (void)read_with("include = [\"parts/wrong.toml\"]"); }),
              HasSubstr("wrong.toml:3: run.0.program"));
  EXPECT_THAT(error_of([&] {
                (void)read_with(
                    "[[run]]\nname = \"a\"\nprogram = \"interFoam\"\n"
                    "case = \"c\"\n");
              }),
              HasSubstr("study.toml:1: title: found nothing"));
}

}  // namespace
}  // namespace surge::compare
