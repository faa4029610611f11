#pragma once

#include <sys/types.h>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace surge::compare {

/// ffmpeg at work on pictures that come through a pipe. No shell takes part.
class VideoPipe {
 public:
  /// Pictures of width x height pixels, both even, red, green and blue a byte each, rows from the
  /// top. `out` must end in .mp4 or .gif; its folder must exist. Throws Error.
  VideoPipe(const std::filesystem::path& out, std::size_t width, std::size_t height, int pictures);
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;
  ~VideoPipe();

  void add(std::span<const std::uint8_t> picture);
  /// The film is whole. Throws Error with what ffmpeg said.
  void finish();

 private:
  [[nodiscard]] std::string end();

  std::filesystem::path out_, unfinished_;
  pid_t child_ = 0;
  int to_ = -1, from_ = -1;
};

}  // namespace surge::compare
