#pragma once

#include <span>
#include <string_view>

namespace surge::compare {

/// A key of a study file, for people and held by a test to be what the reader takes.
struct StudyKey {
  std::string_view table;  ///< "" for the top, "[defaults]", "[[run]]", "[[observable]]"
  std::string_view key;
  std::string_view takes;  ///< kind of value and unit; what stands for it where it is missing
  std::string_view does;
};

/// All tables and keys that read_study() takes, in the order of a study file.
[[nodiscard]] std::span<const StudyKey> study_keys();

}  // namespace surge::compare
