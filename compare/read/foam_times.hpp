#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/read/units.hpp"

namespace surge::compare {

/// The times of an OpenFOAM case at which a field is there, in all of its processor folders.
struct FoamTimes {
  std::vector<Seconds> times;        ///< increasing
  std::vector<std::string> notices;  ///< times that are left out, and why
};

/// The processor folders of a decomposed case, by number; empty for a serial one. Throws
/// surge::Error where one is missing: of the numbers up to the last, of what decomposeParDict
/// announces, or of what another one's patches lead to.
[[nodiscard]] std::vector<std::filesystem::path> foam_processors(
    const std::filesystem::path& folder);

/// Times at which each of the folders (the case's own, or its processors') has the field, as it is
/// or compressed. A time folder whose name is no finite number is none.
[[nodiscard]] FoamTimes foam_times(const std::vector<std::filesystem::path>& folders,
                                   const std::string& field);

/// The names of volume fractions (alpha.*) in the case's first time folder.
[[nodiscard]] std::vector<std::string> foam_phases(const std::filesystem::path& folder);

/// Throws surge::Error where results are in the collated format (folders `processorsN`), which is
/// not read, and the serial case does not have them.
void refuse_collated(const std::filesystem::path& folder, const std::string& field);

}  // namespace surge::compare
