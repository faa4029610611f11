#pragma once

#include <csignal>

namespace surge {

/// Makes a write beyond the system's limit on the size of a file (ulimit -f) fail with its reason,
/// as on a full disk. Otherwise the signal that comes first ends the program without a word.
inline void report_file_size_limit() {
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace surge
