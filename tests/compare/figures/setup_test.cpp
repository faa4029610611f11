#include <gmock/gmock.h>

#include <cmath>
#include <regex>

#include "compare/figures/figures.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_text;
using testing::SyntheticStudy;

/// The script of the set-up where the reference has probes at these heights on the far wall.
std::string script_with_probes_at(const SyntheticStudy& files, const std::vector<double>& heights) {
  const auto file = files.runs() / "vof-20/manifest.json";
  json manifest = json::parse(read_text(file));
  json& probes = manifest["case"]["probes"] = json::array();
  for (const double y : heights)
    probes.push_back({{"name", "p" + std::to_string(probes.size())}, {"position", {0.58, y, 0}}});
  testing::write_text(file, manifest.dump());
  return setup_figure(files.collected()).script;
}

TEST(Setup, NumbersOfPlacesThatAreNearEachOtherStandApart) {
  const SyntheticStudy files;
  const std::string script = script_with_probes_at(files, {0.003, 0.005, 0.007, 0.05});
  std::smatch range;
  ASSERT_TRUE(
      std::regex_search(script, range, std::regex("set xrange \\[([-0-9.e]+):([-0-9.e]+)\\]")));
  const double mm = (std::stod(range[2]) - std::stod(range[1])) / (single_column_mm - 12.0);
  std::vector<double> heights;
  const std::regex number("set label \"[1-4]\" at [-0-9.e]+,([-0-9.e]+) ");
  for (std::sregex_iterator it(script.begin(), script.end(), number), end; it != end; ++it)
    heights.push_back(std::stod((*it)[1]));
  ASSERT_EQ(heights.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(std::abs(heights[i] - heights[j]), 2.6 * mm) << i << ' ' << j;
  EXPECT_NEAR(heights[0], 0.003, 1e-9) << "the first stays beside its place";
  EXPECT_THAT(script, HasSubstr("nohead front lw 0.4"));
}

TEST(Setup, ANumberWithRoomStaysBesideItsPlace) {
  const SyntheticStudy files;
  EXPECT_THAT(script_with_probes_at(files, {0.01, 0.1}), Not(HasSubstr("nohead front lw 0.4")));
}

}  // namespace
}  // namespace surge::compare
