#include "compare/report/swap.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/compare/synthetic_study.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using testing::error_of;
using ::testing::HasSubstr;
using testing::read_text;

class Swap : public ::testing::Test {
 protected:
  void write(const std::string& text) const {
    make_in_place(report_, [&](const fs::path& folder) {
      testing::write_text(folder / "index.html", text);
      testing::write_text(folder / "metrics.json", text);
    });
  }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), {}));
  }
  testing::TemporaryFolder folder_;
  fs::path report_ = folder_ / "report";
};

TEST_F(Swap, ANewReportTakesThePlaceOfTheOld) {
  write("old");
  testing::write_text(report_ / ".finished-1", "");
  testing::write_text(report_ / "figures/fig1.svg", "");
  write("new");
  EXPECT_EQ(read_text(report_ / "index.html"), "new");
  EXPECT_FALSE(fs::exists(report_ / "figures"));
  EXPECT_FALSE(fs::exists(report_ / ".finished-1"));
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Swap, WhatFailsOnTheWayLeavesTheOldReport) {
  write("old");
  EXPECT_EQ(error_of([&] {
              make_in_place(report_, [&](const fs::path& folder) {
                testing::write_text(folder / "index.html", "half");
                throw Error("no more");
              });
            }),
            "no more");
  EXPECT_EQ(read_text(report_ / "index.html"), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Swap, AKillInBetweenLeavesTheOldReportAndIsClearedUpAfter) {
  write("old");
  const pid_t child = fork();
  if (child == 0) {
    make_in_place(report_, [&](const fs::path& folder) {
      testing::write_text(folder / "index.html", "half");
      kill(getpid(), SIGKILL);
    });
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(read_text(report_ / "index.html"), "old");
  EXPECT_EQ(entries(), 2U);
  write("new");
  EXPECT_EQ(read_text(report_ / "index.html"), "new");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Swap, ALinkIsNamedAndNotFollowed) {
  fs::create_directories(folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", report_);
  EXPECT_THAT(error_of([&] { write("new"); }), HasSubstr("report: found a link to"));
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
}

TEST_F(Swap, AFolderWithOtherThingsIsLeftAlone) {
  testing::write_text(report_ / "thesis.tex", "years of work");
  EXPECT_THAT(error_of([&] { write("new"); }), HasSubstr("found thesis.tex"));
  EXPECT_EQ(read_text(report_ / "thesis.tex"), "years of work");
  testing::write_text(folder_ / "file", "");
  EXPECT_THAT(error_of([&] { make_in_place(folder_ / "file", [](const fs::path&) {}); }),
              HasSubstr("found a file, expected a folder"));
}

TEST_F(Swap, APlaceThatCannotBeWrittenToTellsWhy) {
  testing::write_text(folder_ / "file", "");
  EXPECT_THAT(error_of([&] { make_in_place(folder_ / "file/report", [](const fs::path&) {}); }),
              HasSubstr("Not a directory"));
  if (geteuid() != 0) {
    fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THAT(error_of([&] { write("new"); }), HasSubstr("Permission denied"));
    fs::permissions(folder_.path(), fs::perms::owner_all);
  }
}

}  // namespace
}  // namespace surge::compare
