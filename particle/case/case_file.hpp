#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "particle/case/case.hpp"

namespace surge {

/// Reads a case file with overrides `table.key=value`, on top of the preset that it names, and
/// checks it. Throws Error with the place of the first bad entry.
[[nodiscard]] Case read_case(const std::filesystem::path& file,
                             std::span<const std::string> overrides = {});

/// The same for a text; `source` stands for the file's name in errors.
[[nodiscard]] Case parse_case(std::string_view text, const std::string& source,
                              std::span<const std::string> overrides = {});

/// A case as the text of a case file: every option is written out, and reading it gives the same
/// case.
[[nodiscard]] std::string to_toml(const Case& c);

}  // namespace surge
