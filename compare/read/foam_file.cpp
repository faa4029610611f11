#include "compare/read/foam_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include "particle/support/regular_file.hpp"

namespace surge::compare {

namespace fs = std::filesystem;

namespace {

/// A file descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int get() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// Opens without waiting: a pipe that nobody writes to would hold the program for ever.
Descriptor open_regular(const fs::path& file, const fs::path& root) {
  require_inside(file, root);
  Descriptor opened(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (opened.get() < 0) throw Error(file.string() + ": cannot be opened: " + std::strerror(errno));
  struct stat found {};
  if (::fstat(opened.get(), &found) != 0 || !S_ISREG(found.st_mode))
    throw Error(file.string() + ": no regular file, one expected");
  const auto size = static_cast<std::size_t>(found.st_size);
  if (size > most_foam_bytes) {
    throw Error(file.string() + ": " + std::to_string(size) + " bytes found, " +
                std::to_string(most_foam_bytes) + " at most expected");
  }
  constexpr std::size_t slack = std::size_t{1} << 20U;
  // File systems that compress hold less than the size, but no file of numbers in a hundredth.
  if (size > slack && static_cast<std::size_t>(found.st_blocks) * 512U < size / 100U)
    throw Error(file.string() + ": a sparse file without content, one with numbers expected");
  return Descriptor(opened.release());
}

std::string read_plain(const fs::path& file, int descriptor) {
  struct stat found {};
  ::fstat(descriptor, &found);
  std::string text(static_cast<std::size_t>(found.st_size), '\0');
  std::size_t got = 0;
  while (got < text.size()) {
    const ssize_t count = ::read(descriptor, text.data() + got, text.size() - got);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(file.string() + ": cannot be read: " + std::strerror(errno));
    if (count == 0) break;
    got += static_cast<std::size_t>(count);
  }
  text.resize(got);
  return text;
}

std::string read_packed(const fs::path& file, Descriptor descriptor) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> stream(gzdopen(descriptor.get(), "rb"),
                                                             &gzclose_r);
  if (!stream) throw Error(file.string() + ": cannot be unpacked");
  descriptor.release();  // the stream closes it
  constexpr unsigned block = 1U << 18U;
  std::string text;
  while (true) {
    const std::size_t before = text.size();
    text.resize(before + block);
    const int count = gzread(stream.get(), text.data() + before, block);
    if (count < 0) {
      int code = 0;
      const std::string why = gzerror(stream.get(), &code);
      if (code == Z_BUF_ERROR) throw FoamCutShort(file.string() + ": ends before it is unpacked");
      throw Error(file.string() + ": cannot be unpacked: " + why);
    }
    text.resize(before + static_cast<std::size_t>(count));
    if (count == 0) break;
    if (text.size() > most_foam_bytes) {
      throw Error(file.string() + ": more than " + std::to_string(most_foam_bytes) +
                  " bytes when unpacked, fewer expected");
    }
  }
  int code = 0;
  const std::string why = gzerror(stream.get(), &code);
  if (code == Z_BUF_ERROR) throw FoamCutShort(file.string() + ": ends before it is unpacked");
  if (code != Z_OK) throw Error(file.string() + ": cannot be unpacked: " + why);
  if (text.empty()) throw FoamCutShort(file.string() + ": empty");
  if (gzdirect(stream.get()) != 0)
    throw Error(file.string() + ": not compressed, a file made by gzip expected");
  return text;
}

fs::path packed_name(const fs::path& file) {
  return {file.string() + ".gz"};
}

bool is_there(const fs::path& file) {
  std::error_code failed;
  return fs::exists(fs::symlink_status(file, failed));
}

}  // namespace

bool has_foam_file(const fs::path& file) {
  return is_there(file) || is_there(packed_name(file));
}

std::string read_foam_file(const fs::path& file, const fs::path& root) {
  const fs::path packed = packed_name(file);
  if (!is_there(packed)) return read_plain(file, open_regular(file, root).get());
  if (is_there(file)) {
    throw Error(file.string() + ": there is " + packed.filename().string() +
                " besides, one of the two expected (remove the older)");
  }
  return read_packed(packed, open_regular(packed, root));
}

std::vector<fs::path> foam_folders(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failed;
  for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
    std::error_code unseen;
    if (it->is_directory(unseen)) found.push_back(it->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace surge::compare
