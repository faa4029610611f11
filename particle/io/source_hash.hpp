#pragma once

#include <string_view>

namespace surge {

/// Fingerprint of the sources of this program, in hexadecimal: two builds with the same one, of the
/// same compiler and flags, compute the same. Defined in a source that the build generates.
[[nodiscard]] std::string_view source_hash();

}  // namespace surge
