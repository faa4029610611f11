#pragma once

#include <chrono>

namespace surge::linear {

/// Adds the wall-clock seconds since its construction to `seconds` when stopped or destroyed.
class Timer {
 public:
  explicit Timer(double& seconds) : seconds_(&seconds), start_(std::chrono::steady_clock::now()) {}
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  ~Timer() { stop(); }

  void stop() {
    if (seconds_ == nullptr) return;
    *seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    seconds_ = nullptr;
  }

 private:
  double* seconds_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace surge::linear
