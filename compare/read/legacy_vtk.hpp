#pragma once

#include <filesystem>

namespace surge::compare {

/// Checks that a legacy VTK file (ascii or binary, versions 1 to 5) holds as many values as its
/// headers announce: VTK's reader leaves what is missing uninitialised. Throws surge::Error `file:
/// section: n values announced, the file ends before`. What it does not know is left to VTK.
void check_legacy_vtk(const std::filesystem::path& file);

}  // namespace surge::compare
