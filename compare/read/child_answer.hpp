#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "particle/support/error.hpp"

namespace surge::compare {

/// In a child process: from now on no more processor time and memory than reading a file of this
/// size can take; a child that ends is not talked about.
void limit_child(std::uintmax_t bytes);

/// What `work` returned or threw, as one string. The other end takes it apart by result_of().
[[nodiscard]] std::string answer_of(const std::function<std::string()>& work);

/// What was returned; throws surge::Error where that was thrown. The file is named where the text
/// of the error does not.
[[nodiscard]] std::string result_of(std::string answer, const std::filesystem::path& file);

/// The error of a child that ended with this status of waitpid() and without an answer.
[[nodiscard]] Error broken_down(const std::filesystem::path& file, int status);

}  // namespace surge::compare
