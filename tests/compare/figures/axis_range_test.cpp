#include "compare/figures/axis_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/figures/gnuplot.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

Table one_column(const std::vector<double>& values) {
  Table table{"t", {"x", "y"}, {}};
  for (const double value : values) table.add({value, value});
  return table;
}

TEST(AxisRange, IsGnuplotsOwnWhereValuesDiffer) {
  EXPECT_EQ(axis_range("y", one_column({1.0, 2.0}), {1}), "set yrange [*:*]\n");
  EXPECT_EQ(axis_range("x", one_column({}), {0}), "set xrange [*:*]\n");
  EXPECT_EQ(axis_range("x", one_column({std::nan("")}), {0}), "set xrange [*:*]\n");
}

TEST(AxisRange, OfOneValueIsAroundIt) {
  EXPECT_EQ(axis_range("y", one_column({4.0, 4.0, std::nan("")}), {0, 1}), "set yrange [2:6]\n");
  EXPECT_EQ(axis_range("y", one_column({-4.0}), {1}), "set yrange [-6:-2]\n");
  EXPECT_EQ(axis_range("y", one_column({0.0}), {1}), "set yrange [-1:1]\n");
}

TEST(AxisRange, LetsGnuplotDrawOneValueWithoutAWarning) {
  const testing::TemporaryFolder folder;
  Figure figure;
  figure.name = "one";
  figure.tables.push_back(one_column({0.3}));
  for (const char* scale : {"", "set logscale xy\n"}) {
    figure.script = scale + axis_range("x", figure.tables[0], {0}) +
                    axis_range("y", figure.tables[0], {1}) +
                    "plot \"t.csv\" using 1:2 with points notitle\n";
    EXPECT_EQ(draw(figure, folder.path()), "");
  }
}

}  // namespace
}  // namespace surge::compare
