#pragma once

#include <string>

#include "particle/case/case.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// Reads the case out of the tables of a case file. The tables that say how it is computed are left
/// to the reader's user, who calls root.finish() and check_case(). Throws Error with the place of
/// the first bad entry.
[[nodiscard]] Case read_case(const TomlTable& root);

/// A case as the text of a case file: every entry is written out, and reading it gives the same
/// case.
[[nodiscard]] std::string to_toml(const Case& c);

}  // namespace surge
