#pragma once

#include <malloc.h>

#include <fstream>
#include <limits>
#include <string>

namespace surge::benchmarks {

/// The most memory that this process has held at a time since the object was made, beyond what it
/// held then, in bytes. Linux only; elsewhere not a number.
class PeakMemory {
 public:
  PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the high-water mark starts anew
    start_ = status("VmRSS:");
  }
  [[nodiscard]] double bytes() const { return status("VmHWM:") - start_; }

 private:
  static double status(const std::string& key) {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;) {
      double kilobytes = 0.0;
      if (word == key && file >> kilobytes) return 1024.0 * kilobytes;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  double start_ = 0.0;
};

}  // namespace surge::benchmarks
