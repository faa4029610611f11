#include "compare/study/levels_ahead.hpp"

#include <gmock/gmock.h>

#include "compare/study/study_check.hpp"
#include "tests/compare/synthetic.hpp"
#include "tests/places.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct LevelsAhead : ::testing::Test {
  const fs::path source = tests::sources();
  std::string text =
      "title = \"t\"\nreference = \"vof\"\nstrip_height = 0.015\nsnapshot_times = [0.1]\n"
      "published = []\n";

  void add(const std::string& name, const std::string& settings, const std::string& program,
           const std::string& more = "") {
    const bool own_case = program == "interFoam" && settings.find("foam.") == std::string::npos;
    text +=
        "[[run]]\nname = \"" + name + "\"\nprogram = \"" + program + "\"\ncase = \"" +
        (source / (own_case ? "foam_cases/damBreak2D" : "particle/cases/dam_break.toml")).string() +
        "\"\nset = [" + settings + "]\n" + more;
  }
  void particles(const std::string& name, double spacing, const std::string& more = "") {
    add(name, "\"resolution.spacing=" + std::to_string(spacing) + "\"", "surge-particle", more);
  }
  void vof(const std::string& name, int cells, const std::string& more = "") {
    add(name, "\"cellsPerL=" + std::to_string(cells) + "\"", "interFoam", more);
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    const testing::TemporaryFolder folder;
    Study study = read_study(testing::write_text(folder / "study.toml", text));
    check_study(study, tests::programs(), "", source / "compare/reference");
    return verdicts_out_of_reach(study);
  }
  static std::string level(const std::string& group) {
    return "role = \"convergence\"\ngroup = \"" + group + "\"\n";
  }
};

TEST_F(LevelsAhead, OneResolutionIsTold) {
  vof("vof", 20);
  particles("mps", 0.005);
  EXPECT_THAT(lines(), ElementsAre(HasSubstr("vof, mps: found one, expected three resolutions of "
                                             "each, a factor of 1.5 or more apart")));
}

TEST_F(LevelsAhead, ThreeThatAreFarApartAreEnough) {
  vof("vof", 40);
  vof("vof-20", 20, level("v"));
  vof("vof-10", 10, level("v"));
  particles("mps", 0.005);
  particles("mps-14", 0.0145, level("m"));
  particles("mps-29", 0.029, level("m"));
  EXPECT_THAT(lines(), IsEmpty());
}

TEST_F(LevelsAhead, ThreeThatAreNearAreTold) {
  vof("vof", 24);
  vof("vof-20", 20, level("v"));
  vof("vof-16", 16, level("v"));
  EXPECT_THAT(lines(), ElementsAre(HasSubstr("vof: found levels that are nearer")));
}

TEST_F(LevelsAhead, CellsOfACaseFileCount) {
  const auto made = [&](const std::string& name, int cells, const std::string& more) {
    add(name, "\"foam.cellsPerL=" + std::to_string(cells) + "\"", "interFoam", more);
  };
  made("vof", 20, "");
  made("vof-10", 10, level("v"));
  EXPECT_THAT(lines(), ElementsAre(HasSubstr("vof: found two")));
  made("vof-5", 5, level("v"));
  EXPECT_THAT(lines(), IsEmpty());
}

TEST_F(LevelsAhead, OtherSettingsAreAnotherComputationUnlessTheGroupSaysNot) {
  vof("vof", 20);
  vof("vof-10", 10, level("v"));
  add("vof-5", "\"cellsPerL=5\", \"maxCo=0.1\"", "interFoam", level("v"));
  EXPECT_THAT(lines(), ElementsAre(HasSubstr("vof: found two")));
  text.replace(text.find("[\"cellsPerL=20\"]\n"), 17, "[\"cellsPerL=20\"]\ngroup = \"v\"\n");
  EXPECT_THAT(lines(), IsEmpty());
}

}  // namespace
}  // namespace surge::compare
