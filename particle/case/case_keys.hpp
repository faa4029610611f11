#pragma once

#include <span>
#include <string_view>

namespace surge {

/// A key of a case file, for people and held by a test to be what the reader takes.
struct CaseKey {
  std::string_view table;  ///< "" for the top, "[fluid]", "[[block]]"
  std::string_view key;
  std::string_view takes;  ///< kind of value and unit; what stands for it where it is missing
  std::string_view does;
};

/// All tables and keys that read_case() takes, in the order of a case file.
[[nodiscard]] std::span<const CaseKey> case_keys();

}  // namespace surge
