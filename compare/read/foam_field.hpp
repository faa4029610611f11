#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/read/foam_data.hpp"

namespace surge::compare {

/// A field at the cells of one mesh.
struct FoamField {
  std::vector<double> values;        ///< `components` numbers to a cell
  std::vector<std::string> patches;  ///< that boundaryField names, in its order
  std::string location;              ///< time folder that the file was written to
};

/// Reads a volScalarField (1 component) or a volVectorField (3) with as many values as the mesh has
/// cells. `root`: the case, for macros. Throws surge::Error; FoamCutShort where the file ends
/// early, its boundaryField included.
[[nodiscard]] FoamField read_foam_field(const FoamBlock& block, const std::string& place,
                                        const std::filesystem::path& root, std::size_t components,
                                        std::size_t cells);

}  // namespace surge::compare
