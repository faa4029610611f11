#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "particle/support/error.hpp"

namespace surge {

/// The error of a file that could not be written, with the reason of the system call that failed
/// last: a full disk, a folder that is read-only.
[[nodiscard]] inline Error write_error(const std::filesystem::path& file) {
  const std::string why = errno == 0 ? "" : std::string(": ") + std::strerror(errno);
  return Error(file.string() + ": cannot be written" + why);
}

}  // namespace surge
