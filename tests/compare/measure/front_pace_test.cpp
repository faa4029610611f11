#include "compare/measure/front_pace.hpp"

#include <gmock/gmock.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// L = 0.145 m, H = 0.29 m; the front after a time.
std::vector<std::string> notices(const std::function<double(double)>& front, double end = 0.25) {
  Run run;
  run.kind = SourceKind::particle_series;
  run.spacing = Metres(0.005);
  run.physics = testing::dam_break();
  FrontHistory history;
  for (int i = 0; i <= 25; ++i)
    history.push_back({Seconds(end * i / 25), Metres(front(end * i / 25))});
  return pace_notices(run, history);
}

/// interFoam's front of this column to 3 % (Z/L = 1.66 at 0.1 s, 3.07 at 0.2 s).
double collapse(double t) {
  return 0.145 * (1.0 + 66.0 * t * t * (t < 0.1 ? 1.0 : 1.0 - 2.2 * (t - 0.1)));
}

TEST(BoxTime, IsThatOfTheEquationOfMotion) {
  // H -> 0: t = sqrt(1/3) int ds/sqrt(1 - 1/s) = sqrt(1/3) (sqrt(s(s-1)) + ln(sqrt(s)+sqrt(s-1)))
  const double s = 1.5;
  EXPECT_NEAR(box_time(0.0, s),
              (std::sqrt(s * (s - 1)) + std::log(std::sqrt(s) + std::sqrt(s - 1))) / std::sqrt(3.0),
              1e-8);
  // From the equation of motion, integrated in time with g = 9.81: s = 1.23433 at 0.1 s.
  EXPECT_NEAR(box_time(2.0, 1.2343334) * 0.145 / std::sqrt(9.81 * 0.29), 0.1, 1e-6);
}

TEST(FrontPace, SaysNothingOfACollapse) {
  EXPECT_THAT(notices(collapse), IsEmpty());
}

TEST(FrontPace, FindsTimesThatAreOffByMoreThanAFactorOfTwo) {
  for (const double factor : {0.01, 0.1, 0.4, 2.5, 10.0, 100.0}) {
    const auto found = notices([&](double t) { return collapse(t / factor); }, 0.25 * factor);
    ASSERT_EQ(found.size(), 1U) << factor;
    EXPECT_THAT(found[0], HasSubstr("--time-step"));
  }
}

TEST(FrontPace, FindsAFrontThatDoesNotMove) {
  const auto found = notices([](double) { return 0.145; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0], HasSubstr("does not move within 0.25 s"));
}

TEST(FrontPace, IsSilentOverAWetBedAndOfShortRuns) {
  EXPECT_THAT(notices(collapse, 0.04), IsEmpty());
  EXPECT_THAT(notices([](double) { return 0.145; }, 0.03), IsEmpty());
}

}  // namespace
}  // namespace surge::compare
