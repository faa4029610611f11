#pragma once

#include <string>
#include <vector>

#include "compare/measure/front.hpp"

namespace surge::compare {

/// Where one particle makes the leading edge, its lead is part of the edge's uncertainty.
class Leads {
 public:
  /// Looks at a frame of particles whose leading edge is at `edge` (x, m).
  void look(FrameView& view, double edge, const FrontOptions& options);
  /// A line where that was so in any of `frames` frames.
  [[nodiscard]] std::vector<std::string> notices(std::size_t frames) const;

 private:
  std::size_t count_ = 0;
  double most_ = 0.0;  ///< m
};

/// A surge goes forward until it meets a wall, by about as much from frame to frame. Where it goes
/// back or jumps, water has left or joined the main body, or files of a foreign source are out of
/// order or of two runs. Lines about particle files without a manifest only.
[[nodiscard]] std::vector<std::string> course_notices(const Run& run, const FrontHistory& history);

}  // namespace surge::compare
