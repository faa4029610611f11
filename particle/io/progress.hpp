#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace surge {

/// Tells how far a run is. On a terminal one line that is redrawn, with step, simulated time,
/// percent and time left; elsewhere a plain line at every tenth of the run and at least every 30 s.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// `begin`, `end`: simulated time, s
  Progress(std::ostream& out, bool terminal, double end, double begin = 0.0);

  void update(long step, double time, Clock::time_point now = Clock::now());
  /// Ends a line that is still being redrawn.
  void close();

 private:
  [[nodiscard]] int tenths(double time) const;
  [[nodiscard]] std::string line(long step, double time, double elapsed) const;

  std::ostream& out_;
  bool terminal_;
  double end_;
  double begin_;
  Clock::time_point start_;
  Clock::time_point last_;
  int tenths_ = 0;
  bool open_line_ = false;
};

/// Seconds as m:ss or h:mm:ss.
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace surge
