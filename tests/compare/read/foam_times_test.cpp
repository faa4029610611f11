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
using ::testing::UnorderedElementsAre;
using testing::write_text;

TEST(FoamTimes, FoldersWithoutTheFieldAreLeftOutAndTold) {
  const TemporaryFolder folder;
  write_text(folder / "0/alpha.water", "");
  write_text(folder / "0.05/uniform/time", "");
  write_text(folder / "0.1/alpha.water.gz", "");
  write_text(folder / "-0.1/alpha.water", "");
  write_text(folder / "1e400/alpha.water", "");
  write_text(folder / "nan/alpha.water", "");
  write_text(folder / "0.orig/alpha.water", "");
  const FoamTimes found = foam_times({folder.path()}, "alpha.water");
  EXPECT_THAT(found.times, ElementsAre(Seconds(0.0), Seconds(0.1)));
  EXPECT_THAT(found.names, ElementsAre("0", "0.1"));
  EXPECT_THAT(found.notices, UnorderedElementsAre(HasSubstr("0.05 has no alpha.water"),
                                                  HasSubstr("1e400 is no finite number"),
                                                  HasSubstr("nan is no finite number"),
                                                  HasSubstr("-0.1 is before the start")));
}

TEST(FoamTimes, TimeThatAProcessorLacksIsUnfinished) {
  const TemporaryFolder folder;
  for (const char* file :
       {"processor0/0/alpha.water", "processor1/0/alpha.water", "processor0/0.1/alpha.water"})
    write_text(folder / file, "");
  const FoamTimes found = foam_times(foam_processors(folder.path()).folders, "alpha.water");
  EXPECT_THAT(found.times, ElementsAre(Seconds(0.0)));
  EXPECT_THAT(found.notices, ElementsAre(HasSubstr("0.1 is in 1 of 2 processor folders")));
}

TEST(FoamProcessors, MissingOnesAreNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(foam_processors(folder.path()).folders, IsEmpty());
  write_text(folder / "processor0/0/alpha.water", "");
  write_text(folder / "processor2/0/alpha.water", "");
  EXPECT_THAT(error_of([&] { (void)foam_processors(folder.path()); }),
              HasSubstr("processor1 not there"));
  write_text(folder / "processor1/constant/polyMesh/boundary", "procBoundary1to3 { }");
  EXPECT_THAT(error_of([&] { (void)foam_processors(folder.path()); }),
              HasSubstr("processor3 not there"));
  write_text(folder / "processor3/0/alpha.water", "");
  EXPECT_EQ(foam_processors(folder.path()).folders.size(), 4U);
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

TEST(FoamPhases, OldNamesAreFoundWhereThereIsNoOther) {
  const TemporaryFolder folder;
  for (const char* name : {"alpha1", "alphaPhi0", "alpha.water.orig", "p"})
    write_text(folder / "0" / name, "");
  EXPECT_THAT(foam_phases(folder.path()), ElementsAre("alpha1"));
  write_text(folder / "0/alpha.sea_water.gz", "");
  EXPECT_THAT(foam_phases(folder.path()), ElementsAre("alpha.sea_water"));
}

TEST(FoamCollated, FoldersAreInOrderAndComplete) {
  const TemporaryFolder folder;
  EXPECT_THAT(foam_collated(folder.path()).folders, IsEmpty());
  const auto add = [&](const std::string& name) { write_text(folder / (name + "/0/U"), ""); };
  add("processors12_8-11");
  add("processors12_0-3");
  EXPECT_THAT(error_of([&] { (void)foam_collated(folder.path()); }),
              HasSubstr("processor 4 not there, those of 12"));
  add("processors12_4-7");
  const FoamParts parts = foam_collated(folder.path());
  EXPECT_TRUE(parts.collated);
  EXPECT_THAT(parts.folders, ElementsAre(folder / "processors12_0-3", folder / "processors12_4-7",
                                         folder / "processors12_8-11"));
  add("processors2");
  EXPECT_THAT(error_of([&] { (void)foam_collated(folder.path()); }),
              HasSubstr("of 2 and of 12 processors found"));
}

TEST(FoamTimes, OneTimeUnderTwoNamesIsRefused) {
  const TemporaryFolder folder;
  write_text(folder / "0.1/alpha.water", "");
  write_text(folder / "0.10/alpha.water", "");
  EXPECT_THAT(error_of([&] { (void)foam_times({folder.path()}, "alpha.water"); }),
              HasSubstr("0.1 and 0.10 are the same time"));
  std::filesystem::rename(folder / "0.10", folder / "0.1000000000001");
  EXPECT_THAT(error_of([&] { (void)foam_times({folder.path()}, "alpha.water"); }),
              HasSubstr("0.1 and 0.1000000000001 are the same time"));
}

}  // namespace
}  // namespace surge::compare
