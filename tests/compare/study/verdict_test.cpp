#include "compare/study/verdict.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "compare/study/sequences.hpp"
#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using testing::SyntheticStudy;

TEST(Verdict, FollowsTheIntervalAndTheTolerance) {
  EXPECT_EQ(decide(0.02, 0.05, 0.03), Outcome::agrees);
  EXPECT_EQ(decide(-0.02, 0.05, 0.03), Outcome::agrees);
  EXPECT_EQ(decide(0.02, 0.05, 0.031), Outcome::undecided);
  EXPECT_EQ(decide(0.09, 0.05, 0.03), Outcome::differs);
  EXPECT_EQ(decide(-0.09, 0.05, 0.03), Outcome::differs);
  EXPECT_EQ(decide(0.09, 0.05, 0.041), Outcome::undecided);
  EXPECT_EQ(decide(0.0, 0.05, 0.06), Outcome::undecided);  // larger than what is to be judged
  EXPECT_EQ(decide(0.0, 0.05, std::nullopt), Outcome::undecided);
  EXPECT_EQ(decide(std::nan(""), 0.05, 0.01), Outcome::undecided);
}

TEST(Verdict, UncertaintiesAddAsSquares) {
  Verdict verdict;
  verdict.parts = {0.03, 0.04, 0.12, 0.0};
  EXPECT_NEAR(*verdict.parts.combined(), 0.13, 1e-15);
  EXPECT_NEAR(*verdict.interval(), 0.26, 1e-15);
  verdict.parts.reference.reset();
  EXPECT_EQ(verdict.interval(), std::nullopt);
}

TEST(Verdict, MomentsAreTheMiddlesOfEqualParts) {
  EXPECT_THAT(followed_moments(1.0, 17.0), ::testing::ElementsAre(2, 4, 6, 8, 10, 12, 14, 16));
}

TEST(Verdict, WhatIsUndecidedNamesWhatWouldDecideIt) {
  Verdict verdict;
  verdict.run = "a";
  verdict.against = "b";
  verdict.tolerance = 0.05;
  verdict.parts = {0.01, 0.04, 0.0, 0.02};
  verdict.settle("");
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_THAT(verdict.why, HasSubstr("most of which is due to the resolution of b"));
  verdict.parts.reference = 0.0;
  verdict.settle("");
  EXPECT_EQ(verdict.outcome, Outcome::agrees);
  EXPECT_EQ(verdict.why, "");
  verdict.settle("the reason");
  EXPECT_EQ(verdict.why, "the reason");
}

// phi = 1 + h^2: of second order, so that 1.25 |phi1 - phi2| / (r^2 - 1) = 1.25 h1^2.
TEST(Verdict, ALevelIsUncertainByItsIndexAndItsDistanceFromTheFinest) {
  const std::vector<LevelValue> levels{{0.4, 1.16}, {0.1, 1.01}, {0.2, 1.04}};
  EXPECT_NEAR(*level_uncertainty(levels, 1), 1.25 * 0.01, 1e-12);
  EXPECT_NEAR(*level_uncertainty(levels, 2), 0.03 + 1.25 * 0.01, 1e-12);
  EXPECT_NEAR(*level_uncertainty(levels, 0), 0.15 + 1.25 * 0.01, 1e-12);
  EXPECT_EQ(level_uncertainty({{0.1, 1.0}, {0.2, 1.0}}, 0), std::nullopt);
  EXPECT_EQ(level_uncertainty({{0.1, 1.0}, {0.11, 1.0}, {0.12, 1.0}}, 0), std::nullopt);
}

const Verdict* find(const std::vector<Verdict>& all, const std::string& run,
                    const std::string& quantity, const std::string& against) {
  for (const Verdict& verdict : all)
    if (verdict.run == run && verdict.quantity == quantity && verdict.against == against)
      return &verdict;
  return nullptr;
}

TEST(Verdict, OfTheSyntheticStudyAreWhatItWasMadeFor) {
  const SyntheticStudy files;
  files.write("mps-a", "mps", 0.2 * SyntheticStudy::length);
  files.write("sph-a", "sph", -0.01 * SyntheticStudy::length);
  files.refine_all(0.2, -0.01);
  const std::vector<Verdict> all = find_verdicts(files.collected());
  const Verdict* mps = find(all, "mps-a", "leading_edge", "vof-20");
  ASSERT_NE(mps, nullptr);
  EXPECT_EQ(mps->outcome, Outcome::differs);
  EXPECT_NEAR(mps->difference, 0.2, 0.01);
  EXPECT_NEAR(*mps->parts.run, 0.0, 1e-9);
  EXPECT_NEAR(*mps->parts.reference, 0.0, 1e-9);
  EXPECT_GT(*mps->parts.frames, 0.0);  // its front jumps in the first frame
  EXPECT_EQ(find(all, "sph-a", "leading_edge", "vof-20")->outcome, Outcome::agrees);
  // The published points are uncertain by 0.15, half of it a standard uncertainty, and in time.
  const Verdict* read = find(all, "vof-20", "leading_edge", "late");
  ASSERT_NE(read, nullptr);
  EXPECT_GT(*read->parts.data, 0.075);
  EXPECT_EQ(read->parts.reference, 0.0);
}

TEST(Verdict, WithoutRefinementSaysWhatIsMissing) {
  const SyntheticStudy files;
  files.refine("vof-20", "vof", 0.0);
  const std::vector<Verdict> all = find_verdicts(files.collected());
  const Verdict* mps = find(all, "mps-a", "leading_edge", "vof-20");
  EXPECT_EQ(mps->outcome, Outcome::undecided);
  EXPECT_EQ(mps->parts.run, std::nullopt);
  EXPECT_THAT(mps->why, HasSubstr("mps-a at two more resolutions is not there"));
}

TEST(Verdict, OfLevelsThatLieTooNearSaysSo) {
  const SyntheticStudy files;
  files.refine("vof-20", "vof", 0.0);
  files.refine("mps-a", "mps", 0.0, "", {0.016, 0.017});
  const std::vector<Verdict> all = find_verdicts(files.collected());
  const Verdict* mps = find(all, "mps-a", "leading_edge", "vof-20");
  EXPECT_EQ(mps->outcome, Outcome::undecided);
  EXPECT_THAT(mps->why, HasSubstr("three resolutions of mps-a that differ by factors of 1.5"));
}

TEST(Verdict, ARunOfTheComparisonIsALevelOfItsSequenceWhateverItsThreads) {
  const SyntheticStudy files;
  files.refine("mps-a", "mps", 0.02 * SyntheticStudy::length);
  std::string text = read_text(files.study());
  text.replace(text.find("threads = 1"), 11, "threads = 2");
  write_text(files.study(), text);
  const StudyResult study = files.collected();
  const std::vector<Sequence> sequences = sequences_of(study);
  ASSERT_EQ(sequences.size(), 1U);
  ASSERT_EQ(sequences[0].levels.size(), 3U);
  EXPECT_EQ(sequences[0].levels[0].run->study.name, "mps-a");
}

}  // namespace
}  // namespace surge::compare
