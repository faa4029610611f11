#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <vector>

#include "compare/read/foam_mesh.hpp"

class vtkUnstructuredGrid;

namespace surge::compare {

/// Which axes of a case are the comparator's: x along the surge, y or z upwards.
struct FoamAxes {
  std::array<std::size_t, 3> from{0, 1, 2};  ///< the case's axis that is read as x, y, z
  std::array<double, 3> sign{1.0, 1.0, 1.0};

  [[nodiscard]] Vec3 read(const Vec3& v) const {
    return {sign[0] * v[from[0]], sign[1] * v[from[1]], sign[2] * v[from[2]]};
  }
  [[nodiscard]] bool operator==(const FoamAxes&) const = default;
};

/// The cells of all processors, one behind the other; hexahedra, and polyhedra for all else.
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> foam_grid(const std::vector<FoamMesh>& meshes,
                                                             const FoamAxes& axes);

}  // namespace surge::compare
