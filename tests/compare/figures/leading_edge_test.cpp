#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "compare/figures/figures.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_text;
using testing::SyntheticStudy;

TEST(Figures, LeadingEdgeDrawsTheCurves) {
  const SyntheticStudy files;
  const Figure figure = leading_edge_figure(files.collected());
  EXPECT_EQ(draw(figure, files.out()), "");
  // A curve is one path with a vertex per frame: none of the three may be empty.
  const std::string svg = read_text(files.out() / "fig8.svg");
  for (const char* colour : {"rgb(  0, 114, 178)", "rgb(213,  94,   0)", "rgb(  0,   0,   0)"}) {
    std::size_t longest = 0;
    for (auto at = svg.find(colour); at != std::string::npos; at = svg.find(colour, at + 1)) {
      const auto path = svg.find(" d='", at);
      if (path == std::string::npos) break;
      longest = std::max(longest, svg.find('\'', path + 4) - path);
    }
    EXPECT_GT(longest, 150U) << colour;
  }
}

TEST(Figures, DifferenceToTheReferenceIsTheKnownLead) {
  const SyntheticStudy files;
  const Figure figure = leading_edge_figure(files.collected());
  const Table& differences = figure.tables.at(1);
  std::size_t checked = 0;
  for (const auto& row : differences.rows) {
    if (std::get<double>(row[1]) == 0.0) continue;
    const double lead = std::get<std::string>(row[0]) == "mps-a" ? 0.02 : -0.05;
    EXPECT_NEAR(std::get<double>(row[2]), lead, 1e-6);
    ++checked;
  }
  EXPECT_GT(checked, 20U);
}

TEST(Figures, RunsBeyondTheSmallDifferencesHaveAPanelOfTheirOwn) {
  const SyntheticStudy files;
  const auto panels = [&] {
    const std::string script = leading_edge_figure(files.collected()).script;
    std::size_t count = 0;
    for (auto at = script.find("set yrange [-"); at != std::string::npos;
         at = script.find("set yrange [-", at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(panels(), 1U);  // 0.02 and 0.05 L
  files.write("sph-a", "sph", -0.2 * SyntheticStudy::length);
  EXPECT_EQ(panels(), 2U);
}

TEST(Figures, BandOfTheReferenceNeedsItsRefinement) {
  const SyntheticStudy files;
  EXPECT_EQ(leading_edge_figure(files.collected()).tables.size(), 2U);
  files.refine_all();
  const Figure figure = leading_edge_figure(files.collected());
  ASSERT_EQ(figure.tables.size(), 3U);
  EXPECT_EQ(figure.tables[2].name, "fig8_band");
  EXPECT_EQ(draw(figure, files.out()), "");
}

TEST(Figures, ShiftOfAPublishedSeriesIsFoundAndStated) {
  const SyntheticStudy files;
  const Figure figure = shifted_leading_edge_figure(files.collected());
  EXPECT_THAT(figure.script, HasSubstr("Late series, T − 0.20"));
  EXPECT_THAT(leading_edge_figure(files.collected()).script, Not(HasSubstr("T − ")));
}

}  // namespace
}  // namespace surge::compare
