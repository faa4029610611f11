#include "compare/read/method_sheet.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;

TEST(MethodSheet, OptionsAreOnByWhatTheCaseStates) {
  const json stated{
      {"moving_walls", json::array()},
      {"obstacles", {1}},
      {"fluid", {{"kinematic_viscosity", 0.0}}},
      {"method",
       {{"parameters",
         {{"shifting", "none"}, {"distance", 0.5}, {"source", "a"}, {"off", false}}}}}};
  EXPECT_TRUE(is_any_on("", stated));
  EXPECT_FALSE(is_any_on("moving_walls", stated));
  EXPECT_TRUE(is_any_on("obstacles", stated));
  EXPECT_FALSE(is_any_on("kinematic_viscosity", stated));
  EXPECT_FALSE(is_any_on("shifting or source=b or off", stated));
  EXPECT_TRUE(is_any_on("shifting or source=a", stated));
  EXPECT_TRUE(is_any_on("distance", stated));
  EXPECT_TRUE(is_any_on("not_stated", stated));
}

TEST(MethodSheet, AStepHasTheStagesOfItsOptions) {
  MethodSheet sheet;
  sheet.stages = {{"move", "", "", ""},
                  {"shift", "", "", "shifting"},
                  {"survey", "", "", "shifting or negative_pressure=difference"}};
  const auto names = [&](const json& parameters) {
    std::string text;
    for (const auto& stage : sheet.stages_with({{"method", {{"parameters", parameters}}}}))
      text += stage.function + " ";
    return text;
  };
  EXPECT_EQ(names({{"shifting", 0.0}, {"negative_pressure", "clip"}}), "move ");
  EXPECT_EQ(names({{"shifting", 0.0}, {"negative_pressure", "difference"}}), "move survey ");
  EXPECT_EQ(names({{"shifting", 0.1}, {"negative_pressure", "clip"}}), "move shift survey ");
}

}  // namespace
}  // namespace surge::compare
