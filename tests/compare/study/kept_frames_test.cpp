#include "compare/study/kept_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/compare/measure/frames_in_memory.hpp"

namespace surge::compare {
namespace {

using testing::box_mesh;
using testing::dam_break;
using testing::lattice;
using testing::MemoryRun;
using testing::particles;

constexpr Fields pressure_too{.pressure = true};
constexpr Fields both_too{.pressure = true, .velocity = true};

ParticleFrame whole_frame() {
  ParticleFrame frame = particles(lattice({0, 0, 0}, {0.1, 0.1, 0}, 0.01));
  frame.nonfinite = 3;
  frame.pressure.assign(frame.position.size(), 7.0);
  frame.velocity.assign(frame.position.size(), Vec3{1, 2, 3});
  return frame;
}

TEST(KeptFrames, AreReadOnceAndGiveWhatIsAskedFor) {
  MemoryRun memory({whole_frame()}, dam_break(), 0.01);
  keep_frames(memory.run, std::make_shared<FrameBudget>(std::size_t{1} << 20U));
  const auto read = [&](Fields fields) {
    return std::get<ParticleFrame>(memory.run.frames->read(0, fields));
  };
  EXPECT_EQ(read(both_too).velocity.size(), 100U);
  const ParticleFrame again = read(both_too);
  EXPECT_EQ(again.position, whole_frame().position);
  EXPECT_EQ(again.velocity, whole_frame().velocity);
  EXPECT_EQ(again.pressure, whole_frame().pressure);
  EXPECT_EQ(again.nonfinite, 3U);
  EXPECT_EQ(again.time, whole_frame().time);
  EXPECT_EQ(read(pressure_too).pressure.size(), 100U);
  EXPECT_TRUE(read(pressure_too).velocity.empty());
  EXPECT_TRUE(read({}).pressure.empty());
  EXPECT_EQ(memory.frames->reads[0].size(), 1U);
  EXPECT_EQ(memory.run.frames->notices(), std::vector<std::string>{"told once"});
}

TEST(KeptFrames, ThatLackAFieldAreReadAgain) {
  MemoryRun memory({whole_frame()}, dam_break(), 0.01);
  keep_frames(memory.run, std::make_shared<FrameBudget>(std::size_t{1} << 20U));
  (void)memory.run.frames->read(0, pressure_too);
  EXPECT_EQ(std::get<ParticleFrame>(memory.run.frames->read(0, both_too)).velocity.size(), 100U);
  EXPECT_EQ(memory.frames->reads[0].size(), 2U);
}

TEST(KeptFrames, EndWithTheBudgetOfAllRuns) {
  // 100 particles take 5600 bytes and a head.
  const auto budget = std::make_shared<FrameBudget>(10'000);
  MemoryRun first({whole_frame(), whole_frame()}, dam_break(), 0.01);
  MemoryRun second({whole_frame()}, dam_break(), 0.01);
  keep_frames(first.run, budget);
  keep_frames(second.run, budget);
  for (int k = 0; k < 2; ++k) {
    (void)first.run.frames->read(0, both_too);
    (void)first.run.frames->read(1, both_too);
    (void)second.run.frames->read(0, both_too);
  }
  EXPECT_EQ(first.frames->reads[0].size(), 1U);
  EXPECT_EQ(first.frames->reads[1].size(), 2U);
  EXPECT_EQ(second.frames->reads[0].size(), 2U);
}

TEST(KeptFrames, OfMeshesThereAreNone) {
  MemoryRun memory({box_mesh({0.58, 0.58, 0.01}, {4, 4, 1}, [](const Vec3&) { return 1.0; })},
                   dam_break(), 0.145);
  keep_frames(memory.run, std::make_shared<FrameBudget>(std::size_t{1} << 20U));
  for (int k = 0; k < 2; ++k) (void)memory.run.frames->read(0, {});
  EXPECT_EQ(memory.frames->reads[0].size(), 2U);
}

TEST(WaterOfRun, IsReadOnceForEachSizeOfCells) {
  MemoryRun memory({particles(lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.0145))}, dam_break(), 0.0145);
  WaterOfRun water(memory.run);
  const std::vector<bool> fine = water.wet(0, Metres(0.0145));
  EXPECT_EQ(std::count(fine.begin(), fine.end(), true), 200);
  EXPECT_EQ(water.wet(0, Metres(0.0145)), fine);
  EXPECT_EQ(memory.frames->reads[0].size(), 1U);
  const std::vector<bool>& coarse = water.wet(0, Metres(0.029));
  EXPECT_EQ(std::count(coarse.begin(), coarse.end(), true), 50);
  EXPECT_EQ(memory.frames->reads[0].size(), 2U);
}

}  // namespace
}  // namespace surge::compare
