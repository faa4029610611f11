#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>

#include "particle/support/error.hpp"

namespace surge::fuzz {

// What the fuzz targets have in common. A reader may throw surge::Error and nothing else: any other
// exception, a report of a sanitizer, a hang or more memory than an input of a few kB can need is a
// finding.

/// A folder of this process's own, in memory where the machine has such a place; removed at its
/// end.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp");
    name += "/surge_fuzz_XXXXXX";
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file of that name into the folder.
  std::filesystem::path put(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline const Scratch& scratch() {
  static const Scratch folder;
  return folder;
}

/// The same with files in it that an input may name.
inline const Scratch& scratch_with(std::initializer_list<const char*> names) {
  static const bool put = [&] {
    for (const char* name : names) {
      std::filesystem::create_directories((scratch().path() / name).parent_path());
      scratch().put(name, "");
    }
    return true;
  }();
  (void)put;
  return scratch();
}

/// Whether a reader took the input. Where SURGE_FUZZ_TELL is set a line says so for each input, in
/// their order: a corpus that no reader takes any more would never get far into it.
class Verdict {
 public:
  Verdict() = default;
  Verdict(const Verdict&) = delete;
  Verdict& operator=(const Verdict&) = delete;
  ~Verdict() { tell(); }
  void begin() {
    tell();
    begun_ = true;
    taken_ = false;
    refusal_.clear();
  }
  void take() { taken_ = true; }
  void refuse(const char* why) { refusal_.append(refusal_.empty() ? "" : " | ").append(why); }

 private:
  void tell() const {
    if (!begun_ || std::getenv("SURGE_FUZZ_TELL") == nullptr) return;
    std::fprintf(stderr, "verdict: %s\n", taken_ ? "taken" : refusal_.c_str());
  }
  bool begun_ = false, taken_ = false;
  std::string refusal_;
};

inline Verdict& verdict() {
  static Verdict of_this_input;
  return of_this_input;
}

/// The input as text; each target asks for it once.
inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  verdict().begin();
  return {reinterpret_cast<const char*>(data), size};
}

/// A reader may take an input or refuse it; both are right.
template <class Read>
void try_reading(Read&& read) {
  try {
    read();
    verdict().take();
  } catch (const Error& error) {
    verdict().refuse(error.what());
  }
}

/// Calls file(name, content) for the parts of an input that stands for several files: each begins
/// with a line `==> name`.
template <class File>
void each_file(std::string_view text, File&& file) {
  constexpr std::string_view mark = "==> ";
  while (text.starts_with(mark)) {
    const std::size_t line = text.find('\n');
    if (line == std::string_view::npos) return;
    const std::string name(text.substr(mark.size(), line - mark.size()));
    std::size_t next = text.find("\n==> ", line);
    if (next == std::string_view::npos) next = text.size();
    file(name, next > line ? text.substr(line + 1, next - line - 1) : std::string_view());
    text.remove_prefix(next < text.size() ? next + 1 : next);
  }
}

}  // namespace surge::fuzz
