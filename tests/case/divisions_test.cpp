#include "particle/case/divisions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

TEST(Divisions, WholeSpacingsToNineDigits) {
  EXPECT_EQ(whole_spacings(0.58, 0.005), 116.0);
  EXPECT_EQ(whole_spacings(0.58, 0.145 / 29), 116.0);
  EXPECT_FALSE(whole_spacings(0.58, 0.0051));
  EXPECT_FALSE(whole_spacings(0.004, 0.005));
  EXPECT_FALSE(whole_spacings(0.0, 0.005));
}

TEST(Divisions, NearestCommonSpacingsOnBothSides) {
  const NearSpacings near = near_spacings({0.12, 0.04, 0.08, 0.02}, 0.011);
  EXPECT_DOUBLE_EQ(near.below.value(), 0.01);
  EXPECT_DOUBLE_EQ(near.above.value(), 0.02);
  // 0.58 and 0.145 have 0.145 in common, so that it is any whole part of that.
  const NearSpacings column = near_spacings({0.58, 2.32, 0.145, 0.29}, 0.006);
  EXPECT_DOUBLE_EQ(column.below.value(), 0.145 / 25);
  EXPECT_DOUBLE_EQ(column.above.value(), 0.145 / 24);
  EXPECT_FALSE(near_spacings({0.1, 0.2}, 0.15).above.has_value());
  EXPECT_FALSE(near_spacings({}, 0.1).below.has_value());
  // So small that the count of spacings is infinite, or that one more is the same number.
  EXPECT_FALSE(near_spacings({0.1, 0.2}, 1e-320).below.has_value());
  EXPECT_FALSE(near_spacings({0.1, 0.2}, 1e-30).above.has_value());
  // Lengths without a common measure in a thousand spacings.
  EXPECT_FALSE(near_spacings({1.0, 1.41421356237}, 0.4).below.has_value());
}

TEST(Divisions, TheErrorProposesSpacingsAndSizes) {
  try {
    static_cast<void>(test::make_case({"resolution.spacing=0.011"}));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a size of 0.11 or 0.121 m"));
    EXPECT_THAT(error.what(),
                HasSubstr("a spacing of 0.01 or 0.02 m, which divides all sizes of the case"));
  }
  // And what is proposed is accepted.
  EXPECT_NO_THROW(static_cast<void>(test::make_case({"resolution.spacing=0.01"})));
}

TEST(Resolution, ParticlesPerLengthAreAnotherWayToSayIt) {
  EXPECT_DOUBLE_EQ(test::make_case({"resolution.per=8", "resolution.length=0.04"}).spacing, 0.005);
  std::string text = test::small_case;
  const std::string line = "spacing = 0.01\n";
  text.replace(text.find(line), line.size(), "per = 4\nlength = 0.04\n");
  EXPECT_DOUBLE_EQ(parse_computation(text, "small.toml").flow.spacing, 0.01);
  // An override stands for what the file says, whichever way either says it.
  const std::vector<std::string> spacing{"resolution.spacing=0.005"};
  EXPECT_DOUBLE_EQ(parse_computation(text, "small.toml", spacing).flow.spacing, 0.005);

  text.replace(text.find("per = 4"), 7, "per = 4\nspacing = 0.01");
  try {
    static_cast<void>(parse_computation(text, "small.toml"));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("resolution.per: found a spacing besides"));
  }
  EXPECT_THROW(static_cast<void>(test::make_case({"resolution.per=8"})), Error);
}

}  // namespace
}  // namespace surge
