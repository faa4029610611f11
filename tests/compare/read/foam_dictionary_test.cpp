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

TEST(FoamDictionary, MacrosAndDictionariesThatStandBefore) {
  const TemporaryFolder folder;
  const FoamDictionary d = read(folder,
                                "common { rho 1000; inner { a 2; } }\n"
                                "water { $common; nu 1e-06; }\ncopy $common;\n"
                                "x ${common.rho}; y $common/inner/a; z $..common.inner.a;\n"
                                "#includeFunc mag(U)\n#inputMode merge\nlast 3;\n");
  EXPECT_EQ(d.dictionary("water").number("rho"), 1000.0);
  EXPECT_EQ(d.dictionary("water").dictionary("inner").number("a"), 2.0);
  EXPECT_EQ(d.dictionary("copy").number("rho"), 1000.0);
  EXPECT_EQ(d.number("x"), 1000.0);
  EXPECT_EQ(d.number("y"), 2.0);
  EXPECT_EQ(d.number("z"), 2.0);
  EXPECT_EQ(d.number("last"), 3.0);
}

TEST(FoamDictionary, WhatLiesOutsideTheCaseIsNotRead) {
  const TemporaryFolder folder;
  write_text(folder / "outside", "a 1;");
  const auto in_case = [&](const std::string& text) {
    return FoamDictionary::read(write_text(folder / "case/constant/d", text), folder / "case");
  };
  EXPECT_THAT(error_of([&] { (void)in_case("#include \"../../outside\"\n"); }),
              HasSubstr("leads out of"));
  std::filesystem::create_symlink(folder / "outside", folder / "case/constant/link");
  EXPECT_THAT(error_of([&] { (void)in_case("#include \"link\"\n"); }), HasSubstr("leads out of"));
  EXPECT_THAT(error_of([&] { (void)in_case("#include \"$HOME/a\"\n"); }),
              HasSubstr("a file of the case expected"));
  const FoamDictionary d = in_case("#includeEtc \"caseDicts/x\"\nb 2;\n");
  EXPECT_EQ(d.number("b"), 2.0);
  EXPECT_THAT(error_of([&] { (void)d.number("a"); }),
              HasSubstr("not read, outside the case: #includeEtc \"caseDicts/x\""));
}

TEST(FoamDictionary, WhatNeverEndsIsRefused) {
  const TemporaryFolder folder;
  std::string doubled = "a0 1 1;\n", dictionaries = "d0 { a 1; }\n";
  for (int k = 1; k < 64; ++k) {
    const std::string before = std::to_string(k - 1), name = std::to_string(k);
    doubled += std::string("a") + name + " $a" + before + " $a" + before + ";\n";
    dictionaries +=
        std::string("d") + name + " { x { $d" + before + "; } y { $d" + before + "; } }\n";
  }
  EXPECT_THAT(error_of([&] { (void)read(folder, doubled); }), HasSubstr("more than 1000000 words"));
  EXPECT_THAT(error_of([&] { (void)read(folder, dictionaries); }), HasSubstr("after expansion"));
  std::string deep;
  for (int k = 0; k < 1'000'000; ++k) deep += "a{";
  EXPECT_THAT(error_of([&] { (void)read(folder, deep); }), HasSubstr("braces deeper than 64"));
  std::string chain;
  for (int k = 0; k < 60; ++k) chain += "a{";
  chain += "b 1;" + std::string(60, '}') + "\nc { c { c { c { c { $a; } } } } }\n";
  EXPECT_THAT(error_of([&] { (void)read(folder, chain); }), HasSubstr("braces deeper than 64"));
  // Each file includes the next one twice.
  for (int k = 0; k < 15; ++k) {
    const std::string next = "#include \"i" + std::to_string(k + 1) + "\"\n";
    write_text(folder / ("constant/i" + std::to_string(k)), next + next);
  }
  write_text(folder / "constant/i15", "a 1;");
  EXPECT_THAT(error_of([&] { (void)read(folder, "#include \"i0\"\n"); }),
              HasSubstr("#include of more than 64 files"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "a $a$a; b 1 }"); }), HasSubstr("no ; after"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "/* a 1;"); }), HasSubstr("comment without"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "a 1; } b 2;"); }), HasSubstr("} found"));
  EXPECT_THAT(error_of([&] { (void)read(folder, "v (1 0 -9.81 0);").numbers("v", 3); }),
              HasSubstr("3 finite numbers expected"));
}

}  // namespace
}  // namespace surge::compare
