#include "particle/io/step_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "particle/support/error.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

using testing::HasSubstr;

std::string said_by(const std::function<void()>& action) {
  try {
    action();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(StepTable, GoesOnWithTheTableThatIsThere) {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "steps.csv";
  {
    StepTable table(file, {"a"});
    table.add(0.5, {}, {1.0});
    table.flush();
    EXPECT_EQ(table.written(), 1);
    EXPECT_EQ(table.written_until(), 0.5);
  }
  {
    StepTable table(file, 1, 0.5);
    EXPECT_EQ(table.written(), 1);
    table.add(1.0, {}, {2.0});
    EXPECT_EQ(table.written(), 1);
  }
  const std::string text = test::read_text(file);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_THAT(text, testing::EndsWith("\n1,0,0,0,0,0,0,0,0,0,0,0,2\n"));
  EXPECT_NO_THROW(check_rows(file, 2, 1.0));
}

TEST(StepTable, EndsWithAWholeRowWhereTheDiskIsFull) {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "steps.csv";
  {
    const test::FullDisk full(1000);
    StepTable table(file, std::vector<std::string>{});
    for (int k = 0; k < 10; ++k) table.add(k, {}, {});
    table.flush();
    for (int k = 10; k < 1000; ++k) table.add(k, {}, {});
    EXPECT_THAT(said_by([&] { table.flush(); }), HasSubstr("steps.csv: found File too large"));
    EXPECT_EQ(table.written(), 10);
    EXPECT_EQ(table.written_until(), 9.0);
  }
  EXPECT_NO_THROW(check_rows(file, 10, 9.0));
  const std::string text = test::read_text(file);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);
  EXPECT_EQ(text.back(), '\n');
}

TEST(StepTable, NamesTheCause) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT(said_by([&] { StepTable(folder.path() / "no" / "steps.csv", {}); }),
              HasSubstr("found No such file or directory"));
  std::filesystem::create_symlink(folder.path() / "else", folder.path() / "steps.csv");
  EXPECT_THAT(said_by([&] { StepTable(folder.path() / "steps.csv", {}); }),
              HasSubstr("steps.csv: found "));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "else"));
}

}  // namespace
}  // namespace surge
