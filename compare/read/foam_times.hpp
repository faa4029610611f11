#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "compare/read/units.hpp"

namespace surge::compare {

/// The times of an OpenFOAM case at which a field is there, in all of its processor folders.
struct FoamTimes {
  std::vector<Seconds> times;        ///< increasing
  std::vector<std::string> names;    ///< of their folders
  std::vector<std::string> notices;  ///< times that are left out, and why
};

/// Where the parts of a case lie.
struct FoamParts {
  /// The case itself, its folders `processorK`, or those of the collated format: `processorsN`,
  /// or `processorsN_A-B` with the processors A to B.
  std::vector<std::filesystem::path> folders;
  bool collated = false;
  std::size_t processors = 1;
};

/// Time folders of a case or processor by their value. Throws surge::Error where two are the same
/// time (0.1 and 0.10).
[[nodiscard]] std::map<double, std::string> foam_time_folders(const std::filesystem::path& folder);

/// The processor folders of a decomposed case, by number; none for a serial one. Throws
/// surge::Error where one is missing: of the numbers up to the last, of what decomposeParDict
/// announces, or of what another one's patches lead to.
[[nodiscard]] FoamParts foam_processors(const std::filesystem::path& folder);

/// The folders of the collated format; none where there are none. Throws surge::Error where the
/// case has them for two numbers of processors or lacks a part.
[[nodiscard]] FoamParts foam_collated(const std::filesystem::path& folder);

/// Times at which each of the folders (the case's own, or its processors') has the field, as it is
/// or compressed; `field` may begin with a region: "water/alpha.water". Folders that have a number
/// as their name but no time of the flow (-0.1, 1e400, nan) are told.
[[nodiscard]] FoamTimes foam_times(const std::vector<std::filesystem::path>& folders,
                                   const std::string& field);

/// The names of volume fractions (alpha.*; alpha1 and the like where there is none) in the case's
/// first time folder that has any.
[[nodiscard]] std::vector<std::string> foam_phases(const std::filesystem::path& folder,
                                                   const std::string& region = "");

}  // namespace surge::compare
