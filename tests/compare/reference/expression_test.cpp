#include "compare/reference/expression.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::dam_break;
using testing::error_of;
using ::testing::HasSubstr;

double in_si(const std::string& text, const std::string& unit) {
  return evaluate_in(text, unit, case_symbols(dam_break()), "here");
}

TEST(Expression, KnowsUnitsAndTheCase) {
  EXPECT_DOUBLE_EQ(in_si("2*cm", "m"), 0.02);
  EXPECT_DOUBLE_EQ(in_si("rho*g*H", "Pa"), 1000.0 * 9.81 * 0.29);
  EXPECT_DOUBLE_EQ(in_si("sqrt(L/(2*g))", "s"), std::sqrt(0.145 / 19.62));
  EXPECT_DOUBLE_EQ(in_si("L + H - 0.5*H", "m"), 0.29);
  EXPECT_DOUBLE_EQ(in_si("-2^2*m", "m"), -4.0);
  EXPECT_DOUBLE_EQ(in_si("N/(0.5*m)", "N/m"), 2.0);
  EXPECT_DOUBLE_EQ(in_si("m^-1*m2", "m"), 1.0);
  EXPECT_DOUBLE_EQ(in_si("0.25", "Pa"), 0.25);  // a plain number is in SI units
}

TEST(Expression, RefusesWhatIsNone) {
  EXPECT_THAT(error_of([] { (void)in_si("2*cm", "s"); }), HasSubstr("in m, expected s"));
  EXPECT_THAT(error_of([] { (void)in_si("1*m + 1*s", "m"); }), HasSubstr("one dimension"));
  EXPECT_THAT(error_of([] { (void)in_si("2*Q", "m"); }), HasSubstr("\"Q\", expected one of H"));
  EXPECT_THAT(error_of([] { (void)in_si("(2*m", "m"); }), HasSubstr("no closing bracket"));
  EXPECT_THAT(error_of([] { (void)in_si("m/0", "m"); }), HasSubstr("a finite value"));
  EXPECT_THAT(error_of([] { (void)in_si("2 2", "m"); }), HasSubstr("an operator or the end"));
  EXPECT_THAT(error_of([] { (void)in_si("", "m"); }), HasSubstr("a number, a name or a bracket"));
  EXPECT_THAT(error_of([] { (void)in_si("2^m*m", "m"); }), HasSubstr("a power with a dimension"));
  EXPECT_THAT(error_of([] { (void)in_si(std::string(100, '(') + "1", "m"); }),
              HasSubstr("brackets in brackets"));
}

TEST(Expression, NamesAreWholeWords) {
  EXPECT_TRUE(uses("sqrt(H/g)", "H"));
  EXPECT_FALSE(uses("HL*m", "H"));
  EXPECT_FALSE(uses("mm", "m"));
}

}  // namespace
}  // namespace surge::compare
