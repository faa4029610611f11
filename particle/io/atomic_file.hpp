#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace surge {

/// A file that is written under a temporary name, so that readers see the old one or the new one,
/// never a part. What is not committed is removed. Links are replaced, not followed.
class AtomicFile {
 public:
  /// Throws Error with the cause where the file cannot be written, as all functions do.
  explicit AtomicFile(std::filesystem::path file);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
  /// The file takes its name. `durable`: it is on the disk by then, a loss of power included.
  void commit(bool durable = false);

 private:
  [[noreturn]] void fail(int cause) const;

  std::filesystem::path file_;
  std::string unfinished_;
  int descriptor_ = -1;
};

/// Writes all of a file at once.
void write_file(const std::filesystem::path& file, std::string_view text);

/// Returns when what was written to a file or folder is on the disk. Throws Error.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace surge
