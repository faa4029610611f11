#include "particle/io/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "particle/io/restart_error.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

constexpr const char* our_manifest = R"({"program": "surge-particle"})";

TEST(FolderLock, KeepsTheSecondWriterOutUntilTheFirstIsGone) {
  const tests::TemporaryFolder folder;
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
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "run");
  std::filesystem::create_symlink(folder.path() / "target", folder.path() / "run/.lock");
  EXPECT_THROW(FolderLock{folder.path() / "run"}, Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "target"));
}

TEST(FolderLock, LeavesTheFolderFitForARun) {
  const tests::TemporaryFolder folder;
  const FolderLock lock(folder.path() / "run");
  EXPECT_NO_THROW(claim_run_folder(folder.path() / "run", our_manifest, false));
}

class OlderRun : public testing::Test {
 protected:
  OlderRun() {
    std::filesystem::create_directories(run_ / "frames");
    for (const char* name : {"particles.pvd", "steps.csv", "frames/frame_00000.vtp"}) write(name);
    write("manifest.json", R"({"program": "surge-particle", "finished": true})");
  }
  void write(const std::string& name, const std::string& text = "old") {
    std::ofstream(run_ / name) << text;
  }
  [[nodiscard]] bool has(const char* name) const { return std::filesystem::exists(run_ / name); }
  /// What the folder is refused with; empty where it is taken.
  [[nodiscard]] std::string claim(bool force) const {
    try {
      claim_run_folder(run_, our_manifest, force);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  }
  void expect_untouched() const {
    for (const char* name : {"particles.pvd", "steps.csv", "frames/frame_00000.vtp"})
      EXPECT_EQ(test::read_text(run_ / name), "old") << name;
  }

  tests::TemporaryFolder folder_;
  std::filesystem::path run_ = folder_.path() / "run";
};

TEST_F(OlderRun, IsNotReplacedUnasked) {
  EXPECT_THAT(claim(false), testing::AllOf(testing::HasSubstr("found a finished run"),
                                           testing::HasSubstr("--force replaces it"),
                                           testing::Not(testing::HasSubstr("--restart"))));
  expect_untouched();
  EXPECT_THAT(test::read_text(run_ / "manifest.json"), testing::HasSubstr("finished"));
}

TEST_F(OlderRun, ThatCanGoOnIsOfferedToGoOn) {
  write("manifest.json", R"({"program": "surge-particle", "finished": false})");
  write(checkpoint_name);
  EXPECT_THAT(claim(false), testing::AllOf(testing::HasSubstr("found an unfinished run"),
                                           testing::HasSubstr("--restart goes on"),
                                           testing::HasSubstr("--force replaces it")));
  expect_untouched();
}

TEST_F(OlderRun, IsReplacedWithForceAndNothingElseIs) {
  write(checkpoint_name);
  write("notes.txt", "mine");
  write("frames/sketch.png", "mine");
  EXPECT_EQ(claim(true), "");
  for (const char* name : {"particles.pvd", "steps.csv", "frames/frame_00000.vtp", checkpoint_name})
    EXPECT_FALSE(has(name)) << name;
  EXPECT_EQ(test::read_text(run_ / "notes.txt"), "mine");
  EXPECT_EQ(test::read_text(run_ / "frames/sketch.png"), "mine");
  EXPECT_EQ(test::read_text(run_ / "manifest.json"), our_manifest);
}

TEST_F(OlderRun, WithoutAFrameHasNothingToLose) {
  std::filesystem::remove(run_ / "particles.pvd");
  EXPECT_EQ(claim(false), "");
}

TEST_F(OlderRun, IsNotReplacedThroughLinks) {
  const auto elsewhere = folder_.path() / "elsewhere";
  std::filesystem::create_directories(elsewhere);
  std::filesystem::rename(run_ / "frames", elsewhere / "frames");
  std::filesystem::create_symlink(elsewhere / "frames", run_ / "frames");
  EXPECT_THAT(claim(true), testing::HasSubstr("frames: found a link"));
  expect_untouched();
  std::filesystem::remove(run_ / "frames");
  std::filesystem::rename(elsewhere / "frames", run_ / "frames");

  std::filesystem::rename(run_ / "steps.csv", elsewhere / "steps.csv");
  std::filesystem::create_symlink(elsewhere / "steps.csv", run_ / "steps.csv");
  EXPECT_THAT(claim(true), testing::HasSubstr("steps.csv: found a link"));
  expect_untouched();
}

TEST_F(OlderRun, OfAManifestWithOddValuesIsNoneOfOurs) {
  for (const char* text : {"", "[1]", "{", R"({"program": 5})",
                           R"({"program": ["surge-particle"]})", R"({"program": "interFoam"})"}) {
    write("manifest.json", text);
    EXPECT_THAT(claim(true), testing::HasSubstr("and no run of surge-particle")) << text;
  }
  expect_untouched();
  write("manifest.json", R"({"program": "surge-particle", "finished": "yes"})");
  EXPECT_THAT(claim(false), testing::HasSubstr("found an unfinished run"));
}

/// A run of four rows, the last at 0.004 s, and two frames.
class CutBack : public testing::Test {
 protected:
  CutBack() {
    std::filesystem::create_directories(run_ / "frames");
    std::ofstream(run_ / "steps.csv") << "time,dt\n0.001,1\n0.002,1\n0.003,1\n0.004,1\n0.0";
    for (const char* name :
         {"frame_00000.vtp", "frame_00001.vtp", "frame_00002.vtp", "frame_00003.vtp.tmp"})
      std::ofstream(run_ / "frames" / name) << name;
  }
  [[nodiscard]] std::string refusal(long frames, long rows, double time) const {
    try {
      check_results(run_, frames, rows, time);
      return "";
    } catch (const RestartError& error) {
      return error.what();
    }
  }
  tests::TemporaryFolder folder_;
  std::filesystem::path run_ = folder_.path();
};

TEST_F(CutBack, LeavesWhatTheCheckpointFollows) {
  EXPECT_EQ(refusal(2, 3, 0.003), "");
  cut_back(run_, 2, 3);
  EXPECT_EQ(test::read_text(run_ / "steps.csv"), "time,dt\n0.001,1\n0.002,1\n0.003,1\n");
  EXPECT_TRUE(std::filesystem::exists(run_ / "frames/frame_00001.vtp"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(run_ / "frames"), {}), 2);
  EXPECT_EQ(refusal(2, 3, 0.003), "");  // and once more
}

TEST_F(CutBack, IsRefusedWhereSomethingIsMissing) {
  EXPECT_THAT(refusal(4, 3, 0.003), testing::HasSubstr("frame_00003.vtp: found no such frame"));
  EXPECT_THAT(refusal(2, 5, 0.005), testing::HasSubstr("found 4 rows, expected the 5"));
  EXPECT_THAT(refusal(2, 3, 0.0035),
              testing::HasSubstr("found row 3 at 0.003 s, expected 0.0035 s"));
  std::filesystem::remove(run_ / "steps.csv");
  EXPECT_THAT(refusal(2, 3, 0.003), testing::HasSubstr("found 0 rows"));
}

}  // namespace
}  // namespace surge
