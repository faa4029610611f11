#include "compare/study/run_fault.hpp"

#include <utility>

namespace surge::compare {
namespace {

class GuardedReader : public FrameReader {
 public:
  GuardedReader(std::unique_ptr<FrameReader> reader, std::string name, std::filesystem::path files)
      : reader_(std::move(reader)), name_(std::move(name)), files_(std::move(files)) {}

  [[nodiscard]] const std::vector<Seconds>& times() const override { return reader_->times(); }
  [[nodiscard]] Frame read(std::size_t index, Fields fields) override {
    return guarded(name_, files_, [&] { return reader_->read(index, fields); });
  }
  [[nodiscard]] std::vector<std::string> notices() const override { return reader_->notices(); }

 private:
  std::unique_ptr<FrameReader> reader_;
  std::string name_;
  std::filesystem::path files_;
};

}  // namespace

void guard_frames(Run& run, const std::string& name) {
  run.frames = std::make_unique<GuardedReader>(std::move(run.frames), name, run.path);
}

}  // namespace surge::compare
