#pragma once

#include <filesystem>
#include <string>

// Where the tests find what they read and run, and a folder to write to. The paths are compiled
// once, so that a compiler cache serves the tests of every checkout.

namespace surge::tests {

/// The root of the source tree.
std::string sources();

/// The folder of the built programs.
std::string programs();

/// A folder of its own under the system's folder for such files; removed at the end. No two exist
/// under one name, whatever an interrupted test left behind.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace surge::tests
