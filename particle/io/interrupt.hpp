#pragma once

#include <csignal>

namespace surge {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM do not end the program but set a flag; a second one
/// ends it as usual. Only one may live at a time, because signals belong to the process.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  [[nodiscard]] bool interrupted() const;

 private:
  struct sigaction old_int_ {};
  struct sigaction old_term_ {};
};

}  // namespace surge
