#include "particle/io/case_difference.hpp"

#include <gtest/gtest.h>

#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

std::optional<CaseDifference> difference(const std::vector<std::string>& first,
                                         const std::vector<std::string>& second) {
  return case_difference(to_toml(test::make_computation(first)),
                         to_toml(test::make_computation(second)));
}

void expect_key(const std::string& key, const std::string& first, const std::string& second,
                const std::optional<CaseDifference>& found) {
  ASSERT_TRUE(found) << key;
  EXPECT_EQ(found->key, key);
  EXPECT_EQ(found->first, first);
  EXPECT_EQ(found->second, second);
}

TEST(CaseDifference, NamesTheEntry) {
  EXPECT_FALSE(difference({}, {}));
  expect_key("fluid.density", "1000.0", "998.0", difference({}, {"fluid.density=998"}));
  expect_key("time.end", "0.5", "0.02", difference({"time.end=0.5"}, {}));
  expect_key("block.0.velocity", "[0.0,0.0]", "[0.0,1.0]",
             difference({}, {"block.0.velocity=[0, 1]"}));
  expect_key("sph.gamma", "7.0", "5.0", difference({}, {"sph.gamma=5"}));
  expect_key("search.neighbours", "\"cell_grid\"", "\"all_pairs\"",
             difference({}, {"search.neighbours=all_pairs"}));
}

TEST(CaseDifference, NamesWhatOneOfThemLacks) {
  const std::string with = "[a]\nx = 1\n[[b]]\ny = 2\n[[b]]\ny = 3\n";
  const std::string without = "[a]\nx = 1\n[[b]]\ny = 2\n";
  expect_key("b.1.y", "3", "nothing", case_difference(with, without));
  expect_key("b.1.y", "nothing", "3", case_difference(without, with));
  expect_key("a.w", "nothing", "0", case_difference("[a]\nx = 1\n", "[a]\nw = 0\nx = 1\n"));
}

TEST(CaseDifference, CheckpointsMayBeKeptAtOtherTimes) {
  EXPECT_FALSE(difference({"output.checkpoint=1"}, {"output.checkpoint=0"}));
}

TEST(CaseDifference, LongValuesAreCut) {
  const auto found = case_difference("x = " + std::string(1000, '1'), "x = 2");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first.size(), 63U);
}

}  // namespace
}  // namespace surge
