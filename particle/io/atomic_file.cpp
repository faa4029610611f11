#include "particle/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "particle/support/error.hpp"

namespace surge {

namespace fs = std::filesystem;

AtomicFile::AtomicFile(fs::path file)
    : file_(std::move(file)), unfinished_(file_.string() + ".tmp") {
  unlink(unfinished_.c_str());  // of a run that was killed, or a link
  descriptor_ = open(unfinished_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(unfinished_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

void AtomicFile::commit(bool durable) {
  if (durable && fsync(descriptor_) != 0) fail(errno);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  // Some file systems tell only here that there was no room.
  if (close(descriptor) != 0 || rename(unfinished_.c_str(), file_.c_str()) != 0) {
    const int cause = errno;
    unlink(unfinished_.c_str());
    fail(cause);
  }
  if (durable) sync_to_disk(file_.has_parent_path() ? file_.parent_path() : fs::path("."));
}

void AtomicFile::fail(int cause) const {
  throw Error(file_.string() + ": found " + std::strerror(cause) +
              ", expected a place to write to");
}

void write_file(const fs::path& file, std::string_view text) {
  AtomicFile out(file);
  out.write(text);
  out.commit();
}

void sync_to_disk(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && fsync(descriptor) == 0;
  const int cause = errno;
  if (descriptor >= 0) close(descriptor);
  if (!synced) {
    throw Error(path.string() + ": found " + std::strerror(cause) +
                ", expected a place to write to");
  }
}

}  // namespace surge
