#include "particle/support/regular_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "particle/support/error.hpp"

namespace surge {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& found,
                         std::string_view expected) {
  throw Error(file.string() + ": found " + found + ", expected " + std::string(expected));
}

}  // namespace

void require_regular(const fs::path& file, std::uintmax_t most, std::string_view expected) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0)
    refuse(file,
           errno == ENOENT || errno == ENOTDIR ? "no such file" : std::string(std::strerror(errno)),
           expected);
  if (S_ISDIR(found.st_mode)) refuse(file, "a folder", expected);
  if (!S_ISREG(found.st_mode)) refuse(file, "a pipe or a device, not a regular file", expected);
  const auto size = static_cast<std::uintmax_t>(found.st_size);
  if (size > most)
    refuse(file, std::to_string(size) + " bytes",
           "at most " + std::to_string(most) + " of " + std::string(expected));
  // File systems that compress hold less than the size, but no file of numbers in a hundredth.
  constexpr std::uintmax_t slack = std::uintmax_t{1} << 20U;
  if (size > slack && static_cast<std::uintmax_t>(found.st_blocks) * 512U < size / 100U)
    refuse(file, "a sparse file without content", expected);
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  std::error_code failed;
  const fs::path inner = fs::weakly_canonical(file, failed);
  if (failed) throw Error(file.string() + ": " + failed.message());
  const fs::path outer = fs::weakly_canonical(folder, failed);
  if (failed) throw Error(folder.string() + ": " + failed.message());
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

void require_inside(const fs::path& file, const fs::path& folder) {
  if (!is_inside(file, folder))
    throw Error(file.string() + ": leads out of " + folder.string() +
                "; files inside it expected (copy the file there)");
}

std::ifstream open_regular(const fs::path& file, std::uintmax_t most, std::string_view expected) {
  require_regular(file, most, expected);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, std::strerror(errno), expected);
  return stream;
}

std::string read_regular(const fs::path& file, std::uintmax_t most, std::string_view expected) {
  std::ifstream stream = open_regular(file, most, expected);
  std::string text(static_cast<std::size_t>(fs::file_size(file)), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (static_cast<std::size_t>(stream.gcount()) != text.size())
    refuse(file, "an end while it is read", expected);
  return text;
}

}  // namespace surge
