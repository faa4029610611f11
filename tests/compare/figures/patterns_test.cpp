#include <gmock/gmock.h>

#include "compare/figures/figures.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::read_text;
using testing::SyntheticStudy;

/// A study whose runs have 23 frames each, and the run of that name in it.
struct PatternStudy {
  SyntheticStudy files;
  StudyResult study = files.collected();
  MeasuredRun& run(const std::string& name) {
    for (MeasuredRun& measured : study.measured_runs)
      if (measured.run.name == name) return measured;
    throw std::runtime_error(name);
  }
  /// Its frames that are at no time of the reference have no overlap.
  void keep_every(const std::string& name, std::size_t step) {
    PatternHistory& history = run(name).pattern;
    for (std::size_t i = 0; i < history.size(); ++i)
      if (step == 0 || i % step != 0) history[i].overlap.reset();
  }
  Figure drawn() {
    const Figure figure = pattern_figure(study);
    EXPECT_EQ(draw(figure, files.out()), "");
    return figure;
  }
};

const Table& overlap_table(const Figure& figure) {
  return *std::find_if(figure.tables.begin(), figure.tables.end(),
                       [](const Table& table) { return table.name == "overlap"; });
}

TEST(OverlapPanel, OfEqualTimesHasThemAll) {
  PatternStudy made;
  const Figure figure = made.drawn();
  EXPECT_EQ(overlap_table(figure).rows.size(), 2U * 23U);
  EXPECT_THAT(figure.caption, HasSubstr("at the times of which both have a frame. Middle"));
}

TEST(OverlapPanel, OfOtherIntervalsIsALineThroughTheCommonTimes) {
  PatternStudy made;
  made.keep_every("mps-a", 3);
  const Figure figure = made.drawn();
  std::size_t rows = 0;
  for (const auto& row : overlap_table(figure).rows)
    rows += std::get<std::string>(row[0]) == "mps-a" ? 1 : 0;
  EXPECT_EQ(rows, 8U);
  EXPECT_THAT(
      figure.caption,
      HasSubstr("both have a frame: MPS paper, l0 = 5 mm at 8 of its 23 frames, 0 to 0.21 s"));
  // One unbroken line: after the sample in the legend a move to the first and seven lines to the
  // others.
  const std::string svg = read_text(made.files.out() / "patterns.svg");
  const std::string line = svg.substr(svg.find("MPS paper"));
  const std::string path = line.substr(line.find(" d='"), line.find("'/>") - line.find(" d='"));
  const std::string last = path.substr(path.rfind('M'));
  EXPECT_EQ(std::count(last.begin(), last.end(), 'L'), 7) << path;
}

TEST(OverlapPanel, WithoutACommonTimeSaysSo) {
  PatternStudy made;
  made.keep_every("mps-a", 0);
  made.keep_every("sph-a", 0);
  const Figure figure = made.drawn();
  EXPECT_TRUE(overlap_table(figure).rows.empty());
  EXPECT_THAT(figure.caption, HasSubstr("SPH paper, l0 = 5 mm has none of its 23 frames at a time "
                                        "of the reference"));
  const std::string svg = read_text(made.files.out() / "patterns.svg");
  EXPECT_THAT(svg, HasSubstr("MPS paper, l0 = 5 mm: no time in common"));
}

}  // namespace
}  // namespace surge::compare
