#pragma once

#include <filesystem>

namespace surge::compare {

/// Checks a .vtu or .vtp file before VTK reads it, which takes counts in tags on trust: none may be
/// more than the file can hold, and an array in ascii must have as many values as its points and
/// components make (a number that a damage splits shifts all that follow). Throws surge::Error.
void check_xml_vtk(const std::filesystem::path& file);

}  // namespace surge::compare
