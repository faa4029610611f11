#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "compare/read/run.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare::testing {

/// Frames that are there already; remembers how often each was read and what was asked for.
class FramesInMemory : public FrameReader {
 public:
  explicit FramesInMemory(std::vector<Frame> frames) : frames_(std::move(frames)) {
    for (const Frame& frame : frames_) times_.push_back(time_of(frame));
    reads.resize(frames_.size());
  }
  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }
  [[nodiscard]] Frame read(std::size_t index, Fields fields) override {
    reads.at(index).push_back(fields);
    return frames_.at(index);
  }
  [[nodiscard]] std::vector<std::string> notices() const override { return {"told once"}; }

  std::vector<std::vector<Fields>> reads;  ///< per frame

 private:
  std::vector<Frame> frames_;
  std::vector<Seconds> times_;
};

/// A run of frames in memory, and its reader.
struct MemoryRun {
  Run run;
  FramesInMemory* frames = nullptr;

  MemoryRun(std::vector<Frame> all, const Physics& physics, double spacing) {
    auto reader = std::make_unique<FramesInMemory>(std::move(all));
    frames = reader.get();
    run.name = "memory";
    run.path = "memory";
    run.physics = physics;
    run.spacing = Metres(spacing);
    run.kind = std::holds_alternative<MeshFrame>(frames->read(0, {})) ? SourceKind::openfoam
                                                                      : SourceKind::particle_run;
    frames->reads.front().clear();
    run.frames = std::move(reader);
  }
};

}  // namespace surge::compare::testing
