#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle/case/case_checks.hpp"
#include "particle/support/error.hpp"
#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

std::string refusal(const std::vector<std::string>& overrides) {
  try {
    (void)test::make_case(overrides);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> wall(const std::string& lower, const std::string& upper) {
  return {"obstacle.0.lower=" + lower, "obstacle.0.upper=" + upper};
}

// The radius of the small case is 3 h = 3.6 spacings of 0.01 m.

TEST(WallThickness, BaffleThinnerThanTheRadiusIsRefusedWithBothNumbers) {
  const std::string error = refusal(wall("[0.06,0.0]", "[0.07,0.11]"));
  EXPECT_THAT(error, HasSubstr("obstacle.0.upper=[0.07,0.11]: found a wall 0.01 m thick along x"));
  EXPECT_THAT(error, HasSubstr("at least 0.036 m"));
  EXPECT_THAT(error, HasSubstr("a spacing of at most 0.002777 m"));
}

TEST(WallThickness, WallOfTheRadiusPasses) {
  EXPECT_EQ(refusal(wall("[0.06,0.0]", "[0.1,0.11]")), "");
  EXPECT_NE(refusal(wall("[0.06,0.0]", "[0.09,0.11]")), "");
}

TEST(WallThickness, ShelfWithWaterAboveAndBelowIsRefused) {
  EXPECT_THAT(refusal(wall("[0.06,0.04]", "[0.12,0.06]")), HasSubstr("0.02 m thick along y"));
}

TEST(WallThickness, StepsAgainstTheTanksWallsMayBeFlat) {
  EXPECT_EQ(refusal(wall("[0.04,0.0]", "[0.12,0.01]")), "");
  EXPECT_EQ(refusal(wall("[0.11,0.0]", "[0.12,0.12]")), "");
}

TEST(WallThickness, HoldsInThreeDimensionsToo) {
  const std::vector<std::string> solid{"dimension=3",
                                       "fluid.gravity=[0.0,-9.81,0.0]",
                                       "tank.lower=[0.0,0.0,0.0]",
                                       "tank.upper=[0.12,0.12,0.12]",
                                       "block.0.lower=[0.0,0.0,0.0]",
                                       "block.0.upper=[0.04,0.08,0.04]",
                                       "block.0.velocity=[0.0,0.0,0.0]",
                                       "probe.0.position=[0.005,0.005,0.005]",
                                       "obstacle.0.lower=[0.06,0.0,0.04]"};
  std::vector<std::string> thin = solid, thick = solid;
  thin.emplace_back("obstacle.0.upper=[0.12,0.12,0.06]");
  thick.emplace_back("obstacle.0.upper=[0.12,0.12,0.08]");
  EXPECT_THAT(refusal(thin), HasSubstr("0.02 m thick along z"));
  EXPECT_EQ(refusal(thick), "");
}

TEST(Probes, InsideAnObstacleAreRefusedOnItsSurfaceTheyAreNot) {
  EXPECT_THAT(refusal({"probe.0.position=[0.11,0.01]"}),
              HasSubstr("found a place inside obstacle.0"));
  EXPECT_EQ(refusal({"probe.0.position=[0.1,0.01]"}), "");
}

TEST(Counts, FramesAndStepsThatCannotBeCountedAreRefused) {
  EXPECT_THAT(refusal({"output.interval=1e-300"}), HasSubstr("frames"));
  EXPECT_THAT(refusal({"time.end=1e18", "output.interval=1e17"}), HasSubstr("1e+21 steps"));
  EXPECT_THAT(refusal({"time.end=1e18"}), HasSubstr("expected at most"));
}

}  // namespace
}  // namespace surge
