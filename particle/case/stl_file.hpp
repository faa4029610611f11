#pragma once

#include <filesystem>

#include "particle/case/closed_surface.hpp"

namespace surge {

/// Reads the surface of a body from an STL file, ascii or binary, and multiplies its coordinates
/// by `scale`. Corners that are equal to the last digit are one. Throws Error with the file's name
/// where it is no such file or its surface is not that of a body: open, facing inwards, crossing
/// itself, with a normal against the order of its corners, with numbers that are not finite.
[[nodiscard]] ClosedSurface read_stl(const std::filesystem::path& file, double scale);

}  // namespace surge
