#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/read/readers.hpp"

namespace surge::compare {

/// The last number in a file's name, by which its series is ordered.
struct NameNumber {
  long long number = 0;
  std::optional<double> time;  ///< where it is a decimal number, "fluid_0.050.csv"
  std::string stem;            ///< the name with `*` for the number
  std::size_t digits = 0;
  bool padded = false;  ///< with zeros in front
};
[[nodiscard]] std::optional<NameNumber> number_in_name(const std::filesystem::path& file);

/// `*` stands for any characters.
[[nodiscard]] bool matches(std::string_view text, std::string_view pattern);

/// The numbered particle files of a folder by the stem of their names, "fluid_*.vtk".
using Stems = std::map<std::string, std::vector<std::filesystem::path>>;
[[nodiscard]] Stems stems_of(const std::filesystem::path& folder);

/// Takes out the pieces of parallel files (.pvtu, .pvtp): they are no series of their own.
void leave_out_pieces(Stems& stems);

/// The series of one stem (with no pattern), or of one stem for each pattern, whose files of one
/// number make up a time. Throws surge::Error where a pattern fits the files of two runs, where two
/// files have one number, or where a number is missing in one of several patterns.
[[nodiscard]] std::vector<SeriesEntry> list_numbered(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& patterns,
                                                     const std::vector<std::string>& left_out);

}  // namespace surge::compare
