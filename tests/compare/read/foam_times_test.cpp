#include "compare/read/foam_times.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;
using testing::write_text;

TEST(FoamTimes, FoldersWithoutTheFieldAreLeftOutAndTold) {
  const TemporaryFolder folder;
  write_text(folder / "0/alpha.water", "");
  write_text(folder / "0.05/uniform/time", "");
  write_text(folder / "0.1/alpha.water.gz", "");
  write_text(folder / "-0.1/alpha.water", "");
  write_text(folder / "1e400/alpha.water", "");
  write_text(folder / "0.orig/alpha.water", "");
  const FoamTimes found = foam_times({folder.path()}, "alpha.water");
  EXPECT_THAT(found.times, ElementsAre(Seconds(0.0), Seconds(0.1)));
  EXPECT_THAT(found.notices, ElementsAre(HasSubstr("0.05 has no alpha.water"),
                                         HasSubstr("-0.1 is before the start")));
}

TEST(FoamTimes, TimeThatAProcessorLacksIsUnfinished) {
  const TemporaryFolder folder;
  for (const char* file :
       {"processor0/0/alpha.water", "processor1/0/alpha.water", "processor0/0.1/alpha.water"})
    write_text(folder / file, "");
  const FoamTimes found = foam_times(foam_processors(folder.path()), "alpha.water");
  EXPECT_THAT(found.times, ElementsAre(Seconds(0.0)));
  EXPECT_THAT(found.notices, ElementsAre(HasSubstr("0.1 is in 1 of 2 processor folders")));
}

TEST(FoamProcessors, MissingOnesAreNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(foam_processors(folder.path()), IsEmpty());
  write_text(folder / "processor0/0/alpha.water", "");
  write_text(folder / "processor2/0/alpha.water", "");
  EXPECT_THAT(error_of([&] { (void)foam_processors(folder.path()); }),
              HasSubstr("processor1 not there"));
  write_text(folder / "processor1/constant/polyMesh/boundary", "procBoundary1to3 { }");
  EXPECT_THAT(error_of([&] { (void)foam_processors(folder.path()); }),
              HasSubstr("processor3 not there"));
  write_text(folder / "processor3/0/alpha.water", "");
  EXPECT_EQ(foam_processors(folder.path()).size(), 4U);
  write_text(folder / "system/decomposeParDict", "numberOfSubdomains 6;");
  EXPECT_THAT(error_of([&] { (void)foam_processors(folder.path()); }),
              HasSubstr("4 processor folders found, 6 expected"));
}

TEST(FoamPhases, AreThoseOfTheFirstTimeWithAny) {
  const TemporaryFolder folder;
  write_text(folder / "0/U", "");
  write_text(folder / "0.1/alpha.oil", "");
  write_text(folder / "0.1/alpha.oil_0", "");
  EXPECT_THAT(foam_phases(folder.path()), ElementsAre("alpha.oil"));
}

TEST(FoamCollated, IsRefusedUnlessTheCaseHasItsTimes) {
  const TemporaryFolder folder;
  write_text(folder / "0/alpha.water", "");
  write_text(folder / "processors2/0/alpha.water", "");
  EXPECT_EQ(testing::refusal_of([&] { refuse_collated(folder.path(), "alpha.water"); }), "");
  write_text(folder / "processors2/0.1/alpha.water", "");
  EXPECT_THAT(error_of([&] { refuse_collated(folder.path(), "alpha.water"); }),
              HasSubstr("reconstructPar"));
}

}  // namespace
}  // namespace surge::compare
