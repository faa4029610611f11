#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "foam_cases/case_files.hpp"

namespace surge::foam {

/// Reads a case file with overrides `table.key=value` and checks that interFoam computes all that
/// it says. Throws Error with the place of the first entry that it does not.
[[nodiscard]] FoamCase read_foam_case(const std::filesystem::path& file,
                                      std::span<const std::string> overrides,
                                      std::span<const std::string> settings);

/// The same for a text; `source` stands for the file's name.
[[nodiscard]] FoamCase parse_foam_case(std::string_view text, const std::string& source,
                                       std::span<const std::string> overrides,
                                       std::span<const std::string> settings);

/// What is assumed, left to others or not read, one line each.
[[nodiscard]] std::vector<std::string> notes_on(const FoamCase& c);

/// Writes the files of a case into a folder that is not there yet or is empty; with `over` into one
/// that holds a case, whose other files stay. Throws Error.
void write_case(const Files& files, const std::filesystem::path& folder, bool over);

}  // namespace surge::foam
