#pragma once

#include <cstddef>
#include <memory>

#include "compare/measure/flow_pattern.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// Bytes that the frames of a study's runs may take together.
class FrameBudget {
 public:
  explicit FrameBudget(std::size_t bytes) : left_(bytes) {}
  /// Whether so many are left; they are then taken.
  [[nodiscard]] bool take(std::size_t bytes);

 private:
  std::size_t left_;
};

/// Of all frames that are kept: those of a few two-dimensional runs.
inline constexpr std::size_t kept_frame_bytes = std::size_t{256} << 20U;

/// Keeps the frames of particles that are read from now on, as long as the budget allows: of a
/// study's runs they are measured, shown in motion and drawn, and each reading of a file costs a
/// process. What is read is the same.
void keep_frames(Run& run, std::shared_ptr<FrameBudget> budget);

/// What of the frames is kept while a study is collected.
struct StudyFrames {
  std::unique_ptr<WaterOfRun> reference;
  std::shared_ptr<FrameBudget> budget = std::make_shared<FrameBudget>(kept_frame_bytes);
};

}  // namespace surge::compare
