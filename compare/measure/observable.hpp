#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/measure/frame_view.hpp"
#include "compare/read/run.hpp"

namespace surge::compare {

/// A measured quantity over time. A value that is not there at a time is empty, never a number that
/// stands for it.
struct TimeSeries {
  std::string name;  ///< "gauge:x=0.3", "centre-of-mass.x"
  std::string unit;  ///< "m", "Pa", "J/m"; "1" for a plain number
  std::vector<Seconds> times;
  std::vector<std::optional<double>> values;  ///< one per time, finite where there is one

  [[nodiscard]] std::size_t absent() const;
};

/// A curve in space at one time.
struct Profile {
  std::string name;
  std::string position_unit, unit;
  Seconds asked;  ///< the time that was asked for
  Seconds time;   ///< that of the frame nearest to it
  std::vector<double> positions;
  std::vector<std::optional<double>> values;  ///< one per position
};

/// What one observable found in a run.
struct Findings {
  std::vector<TimeSeries> series;
  std::vector<Profile> profiles;
  std::vector<std::string> notices;    ///< what was left out or assumed, a line each
  std::optional<std::string> failure;  ///< why there is nothing
};

/// One way of looking at a run: a value, or several with units, of each frame, or what the program
/// itself has recorded. Each stands in a file of its own with its rule at the head, which is the
/// same for particles and meshes, in two and three dimensions, whatever axis is vertical.
class Observable {
 public:
  virtual ~Observable() = default;
  /// What it needs of a frame besides the water.
  [[nodiscard]] virtual Fields fields() const { return {}; }
  /// Whether it looks at frame number `index`; frames at which nothing looks are not read.
  [[nodiscard]] virtual bool looks_at(std::size_t index) const {
    (void)index;
    return true;
  }
  /// Looks at a frame; frames come in the order of time. Throws surge::Error.
  virtual void look(FrameView& frame) = 0;
  /// What was found in all frames. Throws surge::Error where that cannot be a result.
  [[nodiscard]] virtual Findings findings() = 0;
};

/// An observable with the same columns in every frame.
class FrameObservable : public Observable {
 public:
  struct Column {
    std::string name, unit;
  };
  using Values = std::vector<std::optional<double>>;

  explicit FrameObservable(std::vector<Column> columns);
  void look(FrameView& frame) final;
  [[nodiscard]] Findings findings() override { return std::move(found_); }

 protected:
  /// One value per column. A value that is not finite is an error.
  [[nodiscard]] virtual Values measure(FrameView& frame) = 0;
  [[nodiscard]] const Findings& so_far() const { return found_; }
  void tell(std::string notice) { found_.notices.push_back(std::move(notice)); }

 private:
  Findings found_;
};

}  // namespace surge::compare
