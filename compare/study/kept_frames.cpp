#include "compare/study/kept_frames.hpp"

#include <utility>

namespace surge::compare {
namespace {

bool holds(Fields there, Fields asked) {
  return (there.pressure || !asked.pressure) && (there.velocity || !asked.velocity);
}

std::size_t bytes_of(const ParticleFrame& frame) {
  return sizeof(ParticleFrame) + frame.pressure.size() * sizeof(double) +
         (frame.position.size() + frame.velocity.size()) * sizeof(Vec3);
}

/// What was asked for and no more.
ParticleFrame part_of(const ParticleFrame& frame, Fields asked) {
  ParticleFrame part{frame.time, frame.nonfinite, frame.position, {}, {}};
  if (asked.pressure) part.pressure = frame.pressure;
  if (asked.velocity) part.velocity = frame.velocity;
  return part;
}

class KeepingReader : public FrameReader {
 public:
  KeepingReader(std::unique_ptr<FrameReader> reader, std::shared_ptr<FrameBudget> budget)
      : reader_(std::move(reader)), budget_(std::move(budget)), kept_(reader_->times().size()) {}

  [[nodiscard]] const std::vector<Seconds>& times() const override { return reader_->times(); }
  [[nodiscard]] std::vector<std::string> notices() const override { return reader_->notices(); }

  [[nodiscard]] Frame read(std::size_t index, Fields asked) override {
    if (index < kept_.size() && kept_[index] && holds(kept_[index]->fields, asked))
      return part_of(kept_[index]->frame, asked);
    Frame frame = reader_->read(index, asked);
    const auto* particles = std::get_if<ParticleFrame>(&frame);
    if (particles != nullptr && !kept_[index] && budget_->take(bytes_of(*particles)))
      kept_[index] = Kept{*particles, asked};
    return frame;
  }

 private:
  struct Kept {
    ParticleFrame frame;
    Fields fields;
  };
  std::unique_ptr<FrameReader> reader_;
  std::shared_ptr<FrameBudget> budget_;
  std::vector<std::optional<Kept>> kept_;
};

}  // namespace

bool FrameBudget::take(std::size_t bytes) {
  if (bytes > left_) return false;
  left_ -= bytes;
  return true;
}

void keep_frames(Run& run, std::shared_ptr<FrameBudget> budget) {
  run.frames = std::make_unique<KeepingReader>(std::move(run.frames), std::move(budget));
}

}  // namespace surge::compare
