#pragma once

#include <filesystem>
#include <string>

namespace surge::compare {

/// A study to start from: a case file by three methods and by VOF, and every key that a study
/// takes, commented out where it can be left out. Made from study_keys(), so that it cannot name
/// what is not there. `case_file` is named relative to `folder`, where the study is to lie. Throws
/// surge::Error where the case cannot be read.
[[nodiscard]] std::string new_study_text(const std::filesystem::path& case_file,
                                         const std::filesystem::path& folder);

}  // namespace surge::compare
