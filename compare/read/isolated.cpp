#include "compare/read/isolated.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "compare/read/child_answer.hpp"
#include "compare/read/table_bytes.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

void send(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) _exit(1);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

[[noreturn]] void be_the_child(int descriptor, std::uintmax_t bytes,
                               const std::function<std::string()>& work) {
  limit_child(bytes);
  send(descriptor, answer_of(work));
  _exit(0);
}

std::string all_from(int descriptor) {
  std::string bytes;
  constexpr std::size_t block = std::size_t{1} << 16U;
  while (true) {
    const std::size_t before = bytes.size();
    bytes.resize(before + block);
    const ssize_t count = ::read(descriptor, bytes.data() + before, block);
    bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
  }
}

}  // namespace

std::string in_child(const fs::path& file, const std::function<std::string()>& work) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(file.string() + ": no pipe to read it by: " + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    be_the_child(ends[1], failed ? 0 : size, work);
  }
  ::close(ends[1]);
  std::string bytes = child < 0 ? "" : all_from(ends[0]);
  ::close(ends[0]);
  if (child < 0) throw Error(file.string() + ": no process to read it by: " + std::strerror(errno));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0 || bytes.empty()) throw broken_down(file, status);
  return result_of(bytes, file);
}

ParticleTable table_in_child(const fs::path& file, const std::function<ParticleTable()>& work) {
  const std::string bytes = in_child(file, [&] {
    Packer out;
    put_table(out, work());
    return out.take();
  });
  Unpacker in(bytes);
  return get_table(in);
}

std::vector<FilePart> parts_in_child(const fs::path& file,
                                     const std::function<std::vector<FilePart>()>& work) {
  const std::string bytes = in_child(file, [&] {
    const std::vector<FilePart> parts = work();
    Packer out;
    out.put(parts.size());
    for (const FilePart& part : parts) {
      put_optional(out, part.time);
      put_optional(out, part.step);
      out.put(part.begin);
      out.put(part.end);
      out.put(part.line);
      out.put(part.count);
      out.put(part.star);
    }
    return out.take();
  });
  Unpacker in(bytes);
  std::vector<FilePart> parts(in.get<std::size_t>());
  for (FilePart& part : parts) {
    part.time = get_optional<double>(in);
    part.step = get_optional<long long>(in);
    part.begin = in.get<std::uintmax_t>();
    part.end = in.get<std::uintmax_t>();
    part.line = in.get<std::size_t>();
    part.count = in.get<std::size_t>();
    part.star = in.get<std::string>();
  }
  return parts;
}

}  // namespace surge::compare
