#include "compare/read/foam_dictionary.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

FoamDictionary read(const TemporaryFolder& folder, const std::string& text) {
  return FoamDictionary::read(write_text(folder / "constant/d", text));
}

TEST(FoamDictionary, ReadsWhatTransportPropertiesHold) {
  const TemporaryFolder folder;
  write_text(folder / "system/caseParameters", "nuWater 1e-06; // m2/s\ngravity (0 -9.81 0);\n");
  const FoamDictionary d =
      read(folder,
           "/* header\n */\nFoamFile { version 2.0; class dictionary; }\n"
           "#include \"../system/caseParameters\"\n"
           "phases (water air);\n"
           "water\n{\n  transportModel Newtonian;\n  nu $nuWater;\n  rho rho [1 -3 0] 998.2;\n"
           "  inner { a $:nuWater; }\n}\nvalue $gravity;\n"
           "half #eval{ 0.5*$nuWater };\n");
  EXPECT_DOUBLE_EQ(d.dictionary("water").number("nu"), 1e-6);
  EXPECT_DOUBLE_EQ(d.dictionary("water").number("rho"), 998.2);
  EXPECT_DOUBLE_EQ(d.dictionary("water").dictionary("inner").number("a"), 1e-6);
  EXPECT_THAT(d.numbers("value", 3), ElementsAre(0.0, -9.81, 0.0));
  EXPECT_TRUE(d.has("phases"));
  EXPECT_THAT(error_of([&] { (void)d.number("half"); }), HasSubstr("#eval"));
}

TEST(FoamDictionary, BadFilesAreNamedWithTheirPlace) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { (void)FoamDictionary::read(folder / "no"); }),
              HasSubstr("cannot be opened"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "a 1;\nb 2"); }),
              HasSubstr("d:2: b: the file ends"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "a\n{\nb 2;\n"); }),
              HasSubstr("the file ends inside"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "a { b 2 }\n"); }), HasSubstr("b: no ; after"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "#include \"none\"\n"); }),
              HasSubstr("none: cannot be opened"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "#include \"d\"\n"); }),
              HasSubstr("deeper than 16"));
  const FoamDictionary d = read(folder, "a { b x; }\n");
  EXPECT_THAT(error_of([&] { (void)d.dictionary("a").number("b"); }),
              HasSubstr("d: a: b: \"x\" found"));
  EXPECT_THAT(error_of([&] { (void)d.dictionary("a").number("c"); }),
              HasSubstr("c: nothing found"));
  EXPECT_THAT(error_of([&] { (void)d.dictionary("water"); }), HasSubstr("water: nothing found"));
}

}  // namespace
}  // namespace surge::compare
