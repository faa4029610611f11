#include "compare/read/foam_grid.hpp"

#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <optional>

namespace surge::compare {
namespace {

/// The faces of each cell.
struct CellFaces {
  explicit CellFaces(const FoamMesh& mesh) : start(mesh.cells + 1, 0) {
    const auto each = [&](const auto& action) {
      for (std::size_t f = 0; f < mesh.faces(); ++f) {
        action(f, mesh.owner[f]);
        if (f < mesh.neighbour.size()) action(f, mesh.neighbour[f]);
      }
    };
    each([&](std::size_t, std::size_t cell) { ++start[cell + 1]; });
    for (std::size_t c = 0; c < mesh.cells; ++c) start[c + 1] += start[c];
    faces.resize(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    each([&](std::size_t f, std::size_t cell) { faces[next[cell]++] = f; });
  }
  std::vector<std::size_t> start;
  std::vector<std::size_t> faces;
};

using Loop = std::vector<vtkIdType>;

/// Corners of a face, going round as seen from inside the cell.
Loop loop_of(const FoamMesh& mesh, std::size_t face, std::size_t cell) {
  Loop loop(mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_start[face]),
            mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_start[face + 1]));
  if (mesh.owner[face] == cell) std::reverse(loop.begin() + 1, loop.end());
  return loop;
}

/// The eight corners in VTK's order; empty where the cell is no hexahedron.
std::optional<Loop> hexahedron(const std::vector<Loop>& faces) {
  const bool quads = faces.size() == 6 && std::all_of(faces.begin(), faces.end(),
                                                      [](const Loop& f) { return f.size() == 4; });
  if (!quads) return std::nullopt;
  Loop corners = faces[0];
  const auto in_base = [&](vtkIdType p) {
    return std::find(faces[0].begin(), faces[0].end(), p) != faces[0].end();
  };
  for (std::size_t k = 0; k < 4; ++k) {
    // The edge that leads away from the base.
    std::optional<vtkIdType> above;
    for (std::size_t f = 1; f < 6 && !above; ++f) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (faces[f][i] != corners[k]) continue;
        for (const vtkIdType next : {faces[f][(i + 1) % 4], faces[f][(i + 3) % 4]})
          if (!in_base(next)) above = next;
      }
    }
    if (!above) return std::nullopt;
    corners.push_back(*above);
  }
  Loop sorted = corners;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;
  return corners;
}

void add_cell(vtkUnstructuredGrid& grid, const std::vector<Loop>& faces, vtkIdType first_point) {
  if (auto corners = hexahedron(faces)) {
    for (vtkIdType& p : *corners) p += first_point;
    grid.InsertNextCell(VTK_HEXAHEDRON, 8, corners->data());
    return;
  }
  Loop stream, all;
  for (const Loop& face : faces) {
    stream.push_back(static_cast<vtkIdType>(face.size()));
    for (const vtkIdType p : face) {
      stream.push_back(p + first_point);
      all.push_back(p + first_point);
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  grid.InsertNextCell(VTK_POLYHEDRON, static_cast<vtkIdType>(all.size()), all.data(),
                      static_cast<vtkIdType>(faces.size()), stream.data());
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> foam_grid(const std::vector<FoamMesh>& meshes,
                                               const FoamAxes& axes) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::size_t cells = 0;
  for (const FoamMesh& mesh : meshes) cells += mesh.cells;
  grid->AllocateEstimate(static_cast<vtkIdType>(cells), 8);
  for (const FoamMesh& mesh : meshes) {
    const vtkIdType first = points->GetNumberOfPoints();
    for (const Vec3& p : mesh.points) points->InsertNextPoint(axes.read(p).data());
    const CellFaces of(mesh);
    std::vector<Loop> faces;
    for (std::size_t c = 0; c < mesh.cells; ++c) {
      faces.clear();
      for (std::size_t k = of.start[c]; k < of.start[c + 1]; ++k)
        faces.push_back(loop_of(mesh, of.faces[k], c));
      add_cell(*grid, faces, first);
    }
  }
  grid->SetPoints(points);
  return grid;
}

}  // namespace surge::compare
