#include "compare/read/isolated.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// What stands before the bytes that a child sends.
enum class Sent : char { result = 'r', error = 'e', other = 'o' };

/// Values one after the other as bytes, of one process and its child.
class Packer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  void put(const std::vector<double>& values) {
    put(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    if constexpr (std::is_same_v<T, std::string>) {
      const auto size = get<std::size_t>();
      return std::string(step(size), size);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      T values(get<std::size_t>());
      if (values.empty()) return values;
      std::memcpy(values.data(), step(values.size() * sizeof(double)),
                  values.size() * sizeof(double));
      return values;
    } else {
      T value{};
      std::memcpy(&value, step(sizeof(T)), sizeof(T));
      return value;
    }
  }

 private:
  const char* step(std::size_t size) {
    if (size > bytes_.size() - at_) throw Error("a child process sent too little");
    const char* place = bytes_.data() + at_;
    at_ += size;
    return place;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class T>
void put_optional(Packer& out, const std::optional<T>& value) {
  out.put(value.has_value());
  out.put(value.value_or(T{}));
}
template <class T>
std::optional<T> get_optional(Unpacker& in) {
  const bool there = in.get<bool>();
  const T value = in.get<T>();
  return there ? std::optional(value) : std::nullopt;
}

/// No more than reading a file of this size can take; a child that ends is not talked about.
void limit_child(std::uintmax_t bytes) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU})
    std::signal(signal, SIG_DFL);
  const auto set = [](auto what, rlim_t most) {
    rlimit limit{};
    getrlimit(what, &limit);
    limit.rlim_cur = std::min(most, limit.rlim_max);
    setrlimit(what, &limit);
  };
  set(RLIMIT_CORE, 0);
  set(RLIMIT_CPU, 30 + bytes / 1'000'000);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__clang__)  // whose shadow takes terabytes
  // Values take a thousand times their compressed size at most.
  set(RLIMIT_DATA, (std::uintmax_t{8} << 30U) + 1000 * bytes);
#endif
}

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
  std::string answer;
  Sent kind = Sent::result;
  try {
    answer = work();
  } catch (const Error& error) {
    kind = Sent::error;
    answer = error.what();
  } catch (const std::exception& error) {
    kind = Sent::other;
    answer = error.what();
  }
  const char first = static_cast<char>(kind);
  send(descriptor, {&first, 1});
  send(descriptor, answer);
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

std::string end_text(int status) {
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  return "status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::string in_child(const fs::path& file, const std::function<std::string()>& work,
                     std::optional<std::uintmax_t> size) {
  std::error_code ignored;
  const std::uintmax_t of_file = size ? *size : fs::file_size(file, ignored);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(file.string() + ": no pipe to read it by: " + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    be_the_child(ends[1], of_file, work);
  }
  ::close(ends[1]);
  std::string bytes = child < 0 ? "" : all_from(ends[0]);
  ::close(ends[0]);
  if (child < 0) throw Error(file.string() + ": no process to read it by: " + std::strerror(errno));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status != 0 || bytes.empty())
    throw Error(file.string() + ": the library that reads it broke down (" + end_text(status) +
                "), an undamaged file expected");
  const auto kind = static_cast<Sent>(bytes[0]);
  bytes.erase(0, 1);
  if (kind == Sent::error) throw Error(bytes);
  if (kind == Sent::other) throw Error(file.string() + ": cannot be read: " + bytes);
  return bytes;
}

namespace {

void put_table(Packer& out, const ParticleTable& table) {
  out.put(table.count);
  out.put(table.points);
  out.put(table.arrays.size());
  for (const ParticleArray& array : table.arrays) {
    out.put(array.name);
    out.put(array.components);
    out.put(array.type);
    out.put(array.values);
    out.put(array.words.size());
    for (const std::string& word : array.words) out.put(word);
  }
  put_optional(out, table.time);
  out.put(table.notes.size());
  for (const std::string& note : table.notes) out.put(note);
}

ParticleTable get_table(Unpacker& in) {
  ParticleTable table;
  table.count = in.get<std::size_t>();
  table.points = in.get<std::vector<double>>();
  table.arrays.resize(in.get<std::size_t>());
  for (ParticleArray& array : table.arrays) {
    array.name = in.get<std::string>();
    array.components = in.get<int>();
    array.type = in.get<std::string>();
    array.values = in.get<std::vector<double>>();
    array.words.resize(in.get<std::size_t>());
    for (std::string& word : array.words) word = in.get<std::string>();
  }
  table.time = get_optional<double>(in);
  table.notes.resize(in.get<std::size_t>());
  for (std::string& note : table.notes) note = in.get<std::string>();
  return table;
}

}  // namespace

ParticleTable table_in_child(const fs::path& file, const std::function<ParticleTable()>& work) {
  return tables_in_child({file}, [&](const fs::path&) { return work(); }).front();
}

std::vector<ParticleTable> tables_in_child(
    const std::vector<fs::path>& files, const std::function<ParticleTable(const fs::path&)>& work) {
  std::uintmax_t size = 0;
  std::error_code failed;
  for (const fs::path& file : files) {
    const std::uintmax_t own = fs::file_size(file, failed);
    if (!failed) size += own;
  }
  const std::string bytes = in_child(
      files.front(),
      [&] {
        Packer out;
        for (const fs::path& file : files) put_table(out, work(file));
        return out.take();
      },
      size);
  Unpacker in(bytes);
  std::vector<ParticleTable> tables;
  for (std::size_t i = 0; i < files.size(); ++i) tables.push_back(get_table(in));
  return tables;
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
