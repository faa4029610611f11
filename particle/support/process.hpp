#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surge {

/// What a program that was run to its end left.
struct ProcessEnd {
  int status = 0;    ///< its exit status; -1 where a signal ended it
  std::string said;  ///< its standard output and error, as they came
};

/// Runs a program, found on PATH, in `folder` with nothing on its standard input. No shell takes
/// part, so that arguments mean what they are. The locale is C.UTF-8, whatever the user's: gnuplot
/// warns of letters that a locale lacks, and numbers have points. Throws Error where it cannot be started, with the
/// Debian package that has it.
[[nodiscard]] ProcessEnd run_process(const std::string& program,
                                     const std::vector<std::string>& arguments,
                                     const std::filesystem::path& folder,
                                     const std::string& debian_package);

}  // namespace surge
