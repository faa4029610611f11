#include "particle/io/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace surge {
namespace {

using namespace std::chrono_literals;

TEST(Progress, PlainLinesAtEveryTenth) {
  std::ostringstream out;
  Progress progress(out, false, 1.0);
  const auto start = Progress::Clock::now();
  for (int step = 1; step <= 1000; ++step) progress.update(step, 1e-3 * step, start + step * 1ms);
  progress.close();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_THAT(text, testing::HasSubstr("step 500  t = 0.5000 s of 1 s   50 %"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("\r")));
}

TEST(Progress, PlainLinesAtLeastEveryHalfMinute) {
  std::ostringstream out;
  Progress progress(out, false, 1.0);
  const auto start = Progress::Clock::now();
  for (int step = 1; step <= 100; ++step) progress.update(step, 1e-5 * step, start + step * 1s);
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST(Progress, TerminalLineIsRedrawnWithTimeLeft) {
  std::ostringstream out;
  Progress progress(out, true, 1.0);
  const auto start = Progress::Clock::now();
  progress.update(1, 0.001, start);  // too soon to draw
  EXPECT_EQ(out.str(), "");
  progress.update(250, 0.25, start + 30s);
  progress.close();
  EXPECT_THAT(out.str(), testing::StartsWith("\rstep 250"));
  EXPECT_THAT(out.str(), testing::HasSubstr("25 %  1:30 left"));
  EXPECT_THAT(out.str(), testing::EndsWith("\n"));
}

TEST(Progress, OfARestartCountsItsOwnPartOnly) {
  std::ostringstream out;
  Progress progress(out, true, 1.0, 0.5);
  const auto start = Progress::Clock::now();
  progress.update(750, 0.75, start + 30s);  // half of the half that is its own
  progress.close();
  EXPECT_THAT(out.str(), testing::HasSubstr("75 %  0:30 left"));
}

TEST(DurationText, CountsHoursWhereThereAreAny) {
  EXPECT_EQ(duration_text(0.4), "0:00");
  EXPECT_EQ(duration_text(83.0), "1:23");
  EXPECT_EQ(duration_text(3723.0), "1:02:03");
}

}  // namespace
}  // namespace surge
