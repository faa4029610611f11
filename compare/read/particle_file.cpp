#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataSetReader.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "compare/read/legacy_vtk.hpp"
#include "compare/read/readers.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

template <class Reader>
vtkSmartPointer<vtkPointSet> read_xml(const fs::path& file, const std::optional<Names>& arrays) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->UpdateInformation();
  reader->GetCellDataArraySelection()->DisableAllArrays();
  vtkDataArraySelection* selection = reader->GetPointDataArraySelection();
  if (arrays) {
    selection->DisableAllArrays();
    for (const std::string& name : *arrays) {
      if (selection->ArrayExists(name.c_str())) selection->EnableArray(name.c_str());
    }
  }
  reader->Update();
  return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPointSet> read_legacy(const fs::path& file) {
  check_legacy_vtk(file);
  vtkNew<vtkDataSetReader> reader;
  reader->SetFileName(file.c_str());
  reader->ReadAllFieldsOn();
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->Update();
  return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
}

/// A mesh has its values in cells, and its points are no particles.
void refuse_cells(vtkPointSet& points, const fs::path& file) {
  vtkIdType corners = 0;
  if (auto* mesh = vtkUnstructuredGrid::SafeDownCast(&points)) {
    for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i) {
      const int type = mesh->GetCellType(i);
      if (type != VTK_VERTEX && type != VTK_POLY_VERTEX && type != VTK_EMPTY_CELL) ++corners;
    }
  } else if (auto* surface = vtkPolyData::SafeDownCast(&points)) {
    corners = surface->GetNumberOfPolys() + surface->GetNumberOfStrips();
  }
  if (corners > 0) {
    throw Error(file.string() + ": " + std::to_string(corners) +
                " cells with an extent found, a file of particles (points, vertices) expected");
  }
}

}  // namespace

vtkSmartPointer<vtkPointSet> read_points(const fs::path& file, const std::optional<Names>& arrays) {
  if (!fs::is_regular_file(file)) throw Error(file.string() + ": no such file");
  const VtkErrors errors;
  vtkSmartPointer<vtkPointSet> points;
  const std::string extension = file.extension().string();
  if (extension == ".vtp") points = read_xml<vtkXMLPolyDataReader>(file, arrays);
  if (extension == ".vtu") points = read_xml<vtkXMLUnstructuredGridReader>(file, arrays);
  if (extension == ".vtk") points = read_legacy(file);
  errors.check(file);
  if (!points || points->GetNumberOfPoints() == 0)
    throw Error(file.string() + ": no points found, particles expected");
  refuse_cells(*points, file);
  return points;
}

std::optional<Seconds> stated_time(const fs::path& file) {
  const vtkSmartPointer<vtkPointSet> points = read_points(file, {});
  for (const char* name : {"TimeValue", "TIME", "Time", "time"}) {
    vtkDataArray* array = points->GetFieldData()->GetArray(name);
    if (array && array->GetNumberOfTuples() > 0) return Seconds(array->GetComponent(0, 0));
  }
  return std::nullopt;
}

}  // namespace surge::compare
