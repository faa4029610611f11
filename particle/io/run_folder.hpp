#pragma once

#include <filesystem>
#include <string>

#include "particle/support/error.hpp"

namespace surge {

/// The name of a run's checkpoint in its folder.
inline constexpr const char* checkpoint_name = "checkpoint.bin";

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

/// Makes the folder of a run. One with an older run is taken over where `force` says so or where
/// that run has left no frame: the new manifest replaces the old one first, so that the folder is
/// known as a run's even if we are killed in between, then the other files of the run are removed.
/// Throws Error for an older run without `force`, for a folder that holds anything but a run of
/// this program, and where a link stands for a file of the run. Files that are not the run's are
/// left alone.
void claim_run_folder(const std::filesystem::path& folder, const std::string& manifest, bool force);

/// "frames/frame_00012.vtp"
[[nodiscard]] std::string frame_name(long index);

/// Checks that a run's folder holds what a checkpoint stands on: its first frames and rows of
/// steps.csv, the last of them at this time (s). Throws RestartError with what is missing.
void check_results(const std::filesystem::path& folder, long frames, long rows, double time);

/// Removes frames and rows beyond these.
void cut_back(const std::filesystem::path& folder, long frames, long rows);

}  // namespace surge
