#pragma once

#include <filesystem>
#include <string>

#include "particle/support/error.hpp"

namespace surge {

/// Writes a file under a temporary name and then renames it, so that readers see the old text or
/// the new, never a part. Throws Error.
void write_file(const std::filesystem::path& file, const std::string& text);

/// std::filesystem's functions with our errors.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);
void make_folder(const std::filesystem::path& folder);

/// Keeps other writers out of a run's folder for as long as it lives, this process' and others'.
/// The system takes it back when the process ends, however it does.
class FolderLock {
 public:
  /// Makes the folder. Throws Error where another run is being written there.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

/// Makes the folder of a run, or takes over that of an older one: replaces its manifest, then
/// removes its other files. The new manifest comes first, so that the folder is known as a run's
/// even if we are killed in between. Throws Error for a folder that holds anything but a run of
/// this program; files that are not the run's are left alone.
void claim_run_folder(const std::filesystem::path& folder, const std::string& manifest);

}  // namespace surge
