#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "particle/support/error.hpp"

namespace surge::compare {

/// A file that ends before what it announces: a time that is still being written, or a copy that
/// was cut short.
class FoamCutShort : public Error {
 public:
  using Error::Error;
};

/// Largest file that is read, bytes, after it is unpacked.
constexpr std::size_t most_foam_bytes = std::size_t{4} << 30U;

/// Whether a file is there, as it is or as `name.gz`.
[[nodiscard]] bool has_foam_file(const std::filesystem::path& file);

/// The whole of a file, or of its compressed form `name.gz` where that is there instead. Only
/// regular files inside `root` (links followed) are read, none that is sparse or larger than
/// most_foam_bytes. Throws surge::Error; FoamCutShort where a compressed file ends early.
[[nodiscard]] std::string read_foam_file(const std::filesystem::path& file,
                                         const std::filesystem::path& root);

/// Folders inside `folder`, by name; what cannot be looked at is none.
[[nodiscard]] std::vector<std::filesystem::path> foam_folders(const std::filesystem::path& folder);

}  // namespace surge::compare
