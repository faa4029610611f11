#include "compare/figures/lines_of_text.hpp"

#include <gtest/gtest.h>

namespace surge::compare {
namespace {

TEST(LinesOfText, ALabelIsBrokenAtItsComma) {
  EXPECT_EQ(label_in_two_lines("MPS paper, l0 = 5 mm"), "MPS paper\nl0 = 5 mm");
  EXPECT_EQ(label_in_two_lines("VOF"), "VOF");
}

TEST(LinesOfText, WordsAreBrokenWhereTheWidthAsksForIt) {
  // At 6.5 pt a letter is 6.5 * 0.3528 mm * 0.55 = 1.26 mm wide: 17 of them go into 21.5 mm.
  EXPECT_EQ(lines_within("no frame at this time", 21.5, 6.5), "no frame at this\ntime");
  EXPECT_EQ(lines_within("no frame at this time", 100.0, 6.5), "no frame at this time");
  EXPECT_EQ(lines_within("no frame", 1.0, 6.5), "no\nframe");
  EXPECT_EQ(lines_within("", 10.0, 6.5), "");
}

}  // namespace
}  // namespace surge::compare
