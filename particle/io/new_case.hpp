#pragma once

#include <string>

namespace surge {

/// A case file to start from: a small dam break that is computed as it stands, and every key that
/// a case file takes, commented out where it can be left out. Made from case_keys() and the lists
/// of methods and presets, so that it cannot name what is not there.
/// Throws Error for a dimension other than 2 and 3.
[[nodiscard]] std::string new_case_text(int dimension);

}  // namespace surge
