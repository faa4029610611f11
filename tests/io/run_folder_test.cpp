#include "particle/io/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

TEST(FolderLock, KeepsTheSecondWriterOutUntilTheFirstIsGone) {
  const test::TemporaryFolder folder("lock");
  const auto run = folder.path() / "run";
  std::optional<FolderLock> first(run);
  try {
    const FolderLock second(run);
    FAIL() << "two writers in one folder";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("another run that is being written here"));
  }
  const FolderLock elsewhere(folder.path() / "other");
  first.reset();
  EXPECT_NO_THROW(FolderLock{run});
}

TEST(FolderLock, DoesNotWriteThroughALink) {
  const test::TemporaryFolder folder("lock_link");
  std::filesystem::create_directories(folder.path() / "run");
  std::filesystem::create_symlink(folder.path() / "target", folder.path() / "run/.lock");
  EXPECT_THROW(FolderLock{folder.path() / "run"}, Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "target"));
}

TEST(FolderLock, LeavesTheFolderFitForARun) {
  const test::TemporaryFolder folder("lock_claim");
  const FolderLock lock(folder.path() / "run");
  EXPECT_NO_THROW(claim_run_folder(folder.path() / "run", "{\"program\": \"surge-particle\"}"));
}

}  // namespace
}  // namespace surge
