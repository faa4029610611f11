#include "particle/io/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace surge {

using namespace std::chrono_literals;

Progress::Progress(std::ostream& out, bool terminal, double end, double begin)
    : out_(out),
      terminal_(terminal),
      end_(end),
      begin_(begin),
      start_(Clock::now()),
      last_(start_),
      tenths_(tenths(begin)) {}

int Progress::tenths(double time) const {
  return static_cast<int>(std::floor(10.0 * time / end_ + 1e-9));
}

void Progress::update(long step, double time, Clock::time_point now) {
  const int done = tenths(time);
  const bool due = terminal_ ? now - last_ >= 100ms : done > tenths_ || now - last_ >= 30s;
  if (!due) return;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (terminal_) {
    out_ << '\r' << line(step, time, elapsed) << "\x1b[K"
         << std::flush;  // clears the rest of the line
    open_line_ = true;
  } else {
    out_ << line(step, time, elapsed) << std::endl;
  }
  last_ = now;
  tenths_ = done;
}

void Progress::close() {
  if (open_line_) out_ << '\n' << std::flush;
  open_line_ = false;
}

std::string Progress::line(long step, double time, double elapsed) const {
  const double done = std::clamp(time / end_, 0.0, 1.0);
  const double ours = done - begin_ / end_;
  const std::string left = ours > 0.0 ? duration_text(elapsed * (1.0 - done) / ours) : "?";
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "step %ld  t = %.4f s of %g s  %3.0f %%  %s left", step,
                time, end_, std::floor(100.0 * done + 1e-9), left.c_str());
  return text.data();
}

std::string duration_text(double seconds) {
  const long total = std::lround(std::min(seconds, 3.6e8));
  std::array<char, 32> text{};
  if (total >= 3600) {
    std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld", total / 3600, total / 60 % 60,
                  total % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%ld:%02ld", total / 60, total % 60);
  }
  return text.data();
}

}  // namespace surge
