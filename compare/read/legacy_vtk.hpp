#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>

class vtkPolyData;

namespace surge::compare {

/// The points of a legacy VTK file (ascii or binary, versions 1 to 5; POLYDATA or
/// UNSTRUCTURED_GRID) with their arrays as doubles and its field data. VTK's own reader leaves what
/// is missing uninitialised and ends the program on counts that are wrong, so that the format is
/// read here. Throws surge::Error `file: what` for a file that is cut short, announces what it does
/// not hold, has a section that is not known, or is a mesh.
[[nodiscard]] vtkSmartPointer<vtkPolyData> read_legacy_vtk(const std::filesystem::path& file);

/// The check alone.
void check_legacy_vtk(const std::filesystem::path& file);

}  // namespace surge::compare
