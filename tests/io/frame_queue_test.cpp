#include "particle/io/frame_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <latch>

#include "particle/support/error.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/io/full_disk.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

Snapshot frame_at(double time) {
  Particles<2> one;
  one.resize(1);
  return take_snapshot<2>(one, time);
}

TEST(FrameQueue, WritesEveryFrameInOrder) {
  std::vector<double> written;
  FrameQueue queue([&](const Snapshot& s) { written.push_back(s.time); });
  std::vector<double> pushed;
  for (int k = 0; k < 200; ++k) {
    pushed.push_back(0.005 * k);
    queue.push(frame_at(pushed.back()));
  }
  queue.finish();
  EXPECT_EQ(written, pushed);
}

TEST(FrameQueue, DestructionWritesWhatIsLeft) {
  std::atomic<int> written = 0;
  {
    FrameQueue queue([&](const Snapshot&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ++written;
    });
    for (int k = 0; k < 3; ++k) queue.push(frame_at(k));
  }
  EXPECT_EQ(written, 3);
}

TEST(FrameQueue, PushWaitsWhileTwoFramesAreInFlight) {
  std::latch disk(1);
  std::atomic<int> pushed = 0;
  FrameQueue queue([&](const Snapshot&) { disk.wait(); });
  std::thread run([&] {
    for (int k = 0; k < 5; ++k) {
      queue.push(frame_at(k));
      ++pushed;
    }
  });
  // The third frame has no place until the disk takes the first, however long that is.
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(pushed, 2);
  disk.count_down();
  run.join();
  queue.finish();
  EXPECT_EQ(pushed, 5);
}

TEST(FrameQueue, TheSolverDoesNotWaitForTheDisk) {
  std::latch disk(1);
  FrameQueue queue([&](const Snapshot&) { disk.wait(); });
  queue.push(frame_at(0.0));  // would never return if it wrote by itself
  queue.push(frame_at(1.0));
  disk.count_down();
  queue.finish();
}

TEST(FrameQueue, AnErrorOfTheThreadReachesTheCaller) {
  int attempts = 0;
  FrameQueue queue([&](const Snapshot&) {
    if (++attempts == 2) throw Error("the disk is full");
  });
  const auto run = [&] {
    for (int k = 0; k < 100; ++k) queue.push(frame_at(k));
    queue.finish();
  };
  EXPECT_THROW(run(), Error);
  EXPECT_THROW(queue.finish(), Error);  // and it stays
  EXPECT_EQ(attempts, 2);
}

TEST(FrameQueue, AFolderThatVanishesIsAnError) {
  const tests::TemporaryFolder folder;
  FrameQueue queue(FrameWriter(folder.path(), "density"));
  queue.push(frame_at(0.0));
  queue.finish();
  std::filesystem::remove_all(folder.path() / "frames");
  queue.push(frame_at(1.0));
  EXPECT_THROW(queue.finish(), Error);
}

TEST(FrameQueue, AFullDiskIsAnErrorAndLeavesNoFrame) {
  const tests::TemporaryFolder folder;
  FrameQueue queue(FrameWriter(folder.path(), "density"));
  {
    const test::FullDisk full(100);
    queue.push(frame_at(0.0));
    EXPECT_THROW(queue.finish(), Error);
  }
  EXPECT_EQ(queue.written(), 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "frames"));
}

TEST(FrameQueue, WritesNothingThroughLinks) {
  const tests::TemporaryFolder folder;
  FrameQueue queue(FrameWriter(folder.path(), "density"));
  const auto target = folder.path() / "target";
  for (const char* name : {"frames/frame_00000.vtp.tmp", "frames/frame_00000.vtp"})
    std::filesystem::create_symlink(target, folder.path() / name);
  queue.push(frame_at(0.0));
  queue.finish();
  EXPECT_EQ(queue.written(), 1);
  EXPECT_FALSE(std::filesystem::exists(target));
  EXPECT_TRUE(std::filesystem::is_regular_file(
      std::filesystem::symlink_status(folder.path() / "frames/frame_00000.vtp")));
}

}  // namespace
}  // namespace surge
