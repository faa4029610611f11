#pragma once

#include "compare/measure/front.hpp"
#include "compare/measure/front_course.hpp"
#include "compare/measure/observable.hpp"

namespace surge::compare {

/// The leading edge (front.hpp) as an observable: its distance from the wall that the column stands
/// at, m. It is followed until a frame has none any more, as in a run that broke up; that frame and
/// those after it have no value. At the first frame it must be the column's edge, and it must move
/// as fast as water can.
class FrontObservable : public FrameObservable {
 public:
  FrontObservable(const Run& run, const FrontOptions& options, const std::string& name);
  [[nodiscard]] bool looks_at(std::size_t index) const override {
    (void)index;
    return !lost_;
  }
  [[nodiscard]] Findings findings() override;

  /// What was found up to the frame without a leading edge.
  [[nodiscard]] const FrontHistory& history() const { return history_; }
  /// What its course tells about the files: where it goes back, jumps or is one particle's.
  [[nodiscard]] std::vector<std::string> course() const;

 protected:
  [[nodiscard]] Values measure(FrameView& frame) override;

 private:
  const Run& run_;
  FrontOptions options_;
  FrontHistory history_;
  Leads leads_;
  bool lost_ = false;
};

/// The other choices that measure_front_variants() makes, by their names.
[[nodiscard]] std::vector<std::pair<std::string, FrontOptions>> front_variants_of(
    const Run& run, const FrontOptions& options);

/// What the front that is used assumes and tells goes to the run's notices.
void tell_of_front(Run& run, const FrontObservable& front, const FrontOptions& options);

}  // namespace surge::compare
