#pragma once

#include <cstddef>
#include <utility>

#include "compare/measure/observable.hpp"

namespace surge::compare {

/// A series that was recorded beside the frames: nothing of them is needed.
class RecordedObservable : public Observable {
 public:
  explicit RecordedObservable(Findings found) : found_(std::move(found)) {}
  [[nodiscard]] bool looks_at(std::size_t index) const override {
    (void)index;
    return false;
  }
  void look(FrameView& frame) override { (void)frame; }
  [[nodiscard]] Findings findings() override { return std::move(found_); }

 private:
  Findings found_;
};

}  // namespace surge::compare
