#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace surge {

// Files that are given to the programs. One that could hold a reader for ever (a pipe, a device) or
// that announces what the disk does not hold (a sparse file of terabytes) is refused before it is
// opened. Links are followed, but out of a run's folder only where its own path leads. `expected`
// is what errors call the file: "a TOML file".

/// Throws Error `file: found ..., expected ...` unless it is a regular file of at most `most` bytes
/// that is not sparse. Every reader of a file in full goes through here.
void require_regular(const std::filesystem::path& file, std::uintmax_t most,
                     std::string_view expected);

/// The same, opened for reading.
[[nodiscard]] std::ifstream open_regular(const std::filesystem::path& file, std::uintmax_t most,
                                         std::string_view expected);

/// Its whole content.
[[nodiscard]] std::string read_regular(const std::filesystem::path& file, std::uintmax_t most,
                                       std::string_view expected);

/// Whether a file lies in a folder, or would, when all links are followed. Throws Error where links
/// go round.
[[nodiscard]] bool is_inside(const std::filesystem::path& file,
                             const std::filesystem::path& folder);

/// Throws Error unless that is so: what lies elsewhere does not belong to a run.
void require_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

/// The largest table in text that is gone through line by line, bytes.
inline constexpr std::uintmax_t most_table_bytes = std::uintmax_t{64} << 30U;

}  // namespace surge
