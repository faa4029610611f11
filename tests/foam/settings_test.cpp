#include "foam_cases/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/foam/foam_fixture.hpp"

namespace surge::foam {
namespace {

using test::made;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

Settings settings(const std::vector<std::string>& assignments) {
  return read_settings(assignments);
}

TEST(Settings, AreReadByTheNamesOfTheDictionary) {
  const Settings s = settings({"cellsPerL=12", "velocityScheme=limitedLinearV 1", "maxCo=0.25",
                               "momentumPredictor=yes", "writeFormat=ascii", "cAlpha=0"});
  EXPECT_EQ(s.cells_per_length, 12);
  EXPECT_EQ(s.velocity_scheme, "limitedLinearV 1");
  EXPECT_EQ(s.courant, 0.25);
  EXPECT_EQ(s.momentum_predictor, "yes");
  EXPECT_EQ(s.c_alpha, 0.0);
  EXPECT_EQ(settings({"cells_per_length=7", "length=0.3"}).cells_per_length, 7);
  EXPECT_EQ(settings({"length=0.3"}).length, 0.3);
}

TEST(Settings, WhatTheCaseDecidesIsFilledIn) {
  const Settings s = made().settings;
  EXPECT_DOUBLE_EQ(s.length, 0.1);
  EXPECT_EQ(s.first_step, 1e-4);
  EXPECT_EQ(s.maximum_step, 1e-3);
  EXPECT_EQ(made({"maxDeltaT=5e-4"}).settings.maximum_step, 5e-4);
}

TEST(Settings, MistakesAreErrorsThatSayWhatIsMeant) {
  EXPECT_THAT(refusal({"cellPerL=20"}),
              AllOf(HasSubstr("--foam cellPerL=20"), HasSubstr("cellsPerL")));
  EXPECT_THAT(refusal({"endTime=2"}), HasSubstr("expected --set time.end=..."));
  EXPECT_THAT(refusal({"cellsPerL"}), HasSubstr("expected key=value"));
  EXPECT_THAT(refusal({"cellsPerL=2.5"}),
              HasSubstr("--foam cellsPerL=2.5: found 2.5, expected a whole number"));
  EXPECT_THAT(refusal({"cellsPerL=0"}), HasSubstr("expected a whole number"));
  EXPECT_THAT(refusal({"maxCo=-1"}), HasSubstr("maxCo"));
  EXPECT_THAT(refusal({"solver=icoFoam"}), HasSubstr("interIsoFoam"));
  EXPECT_THAT(refusal({"writeCompression=on"}), HasSubstr("expected ascii"));
  EXPECT_THAT(refusal({"deltaT=0.1"}), HasSubstr("at most maxDeltaT"));
}

TEST(Settings, NothingInATextIsExecutedByOpenFoam) {
  for (const char* bad : {"timeScheme=Euler; #calc \"x\"", "timeScheme=#codeStream",
                          "alphaScheme=$x", "velocityScheme=a\nb", "velocityScheme=\"\""})
    EXPECT_THAT(refusal({bad}), HasSubstr("expected")) << bad;
}

TEST(Settings, TextsOfTheCaseCannotEndAnEntry) {
  std::string text = test::small_case;
  text.replace(text.find("Small"), 5, R"(a \"b\"; #calc { $c } \\)");
  EXPECT_EQ(made({}, {}, text).flow.title, "a \"b\"; #calc { $c } \\");
  const std::string parameters = case_files(made({}, {}, text)).at("system/caseParameters");
  EXPECT_THAT(parameters, HasSubstr("title               \"a 'b'; #calc { _c } /\";"));
}

TEST(Settings, TablesOfTheCaseAreCheckedAndThoseOfMethodsLeft) {
  EXPECT_EQ(refusal({}), "made");
  EXPECT_THAT(refusal({}, {"tank.uper=[1, 1]"}), HasSubstr("tank.uper"));
  EXPECT_THAT(refusal({}, {"obstacles.lower=1"}), HasSubstr("obstacles"));
  EXPECT_THAT(refusal({}, {"its_own_table.option=2"}), HasSubstr("interFoam does not read"));
}

}  // namespace
}  // namespace surge::foam
