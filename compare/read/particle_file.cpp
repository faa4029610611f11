#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <new>

#include "compare/read/legacy_vtk.hpp"
#include "compare/read/particle_table.hpp"
#include "compare/read/readers.hpp"
#include "compare/read/xml_vtk.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

template <class Reader>
vtkSmartPointer<vtkPointSet> read_xml(const fs::path& file, const std::optional<Names>& arrays) {
  check_xml_vtk(file);
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
  require_regular(file);
  const VtkErrors errors;
  vtkSmartPointer<vtkPointSet> points;
  const std::string extension = file.extension().string();
  try {
    if (extension == ".vtp") points = read_xml<vtkXMLPolyDataReader>(file, arrays);
    if (extension == ".vtu") points = read_xml<vtkXMLUnstructuredGridReader>(file, arrays);
    if (extension == ".vtk") points = read_legacy_vtk(file);
  } catch (const std::bad_alloc&) {
    throw Error(file.string() + ": announces more values than memory holds");
  }
  errors.check(file);
  if (!points || points->GetNumberOfPoints() == 0)
    throw Error(file.string() + ": no points found, particles expected");
  refuse_cells(*points, file);
  return points;
}

std::optional<Seconds> stated_time(const fs::path& file, const std::string& name) {
  const vtkSmartPointer<vtkPointSet> points = read_points(file, Names{});
  std::vector<std::string> names{"TimeValue", "TIME", "Time", "time"};
  if (!name.empty()) names = {name};
  for (const std::string& known : names) {
    vtkDataArray* array = points->GetFieldData()->GetArray(known.c_str());
    if (array && array->GetNumberOfTuples() > 0) return Seconds(array->GetComponent(0, 0));
  }
  if (!name.empty())
    throw Error(file.string() + ": no field data " + name +
                " found, a time expected (--time-array)");
  return std::nullopt;
}

std::vector<FilePart> vtk_parts(const fs::path& file, const SourceOptions& options) {
  FilePart part;
  if (const auto time = stated_time(file, options.time_array)) part.time = time->value();
  return {part};
}

ParticleTable read_vtk(const fs::path& file, const ArrayNames& wanted) {
  const vtkSmartPointer<vtkPointSet> points = read_points(file, wanted);
  ParticleTable table;
  const vtkIdType count = points->GetNumberOfPoints();
  table.count = static_cast<std::size_t>(count);
  table.points.reserve(3 * table.count);
  for (vtkIdType i = 0; i < count; ++i) {
    const double* x = points->GetPoint(i);
    table.points.insert(table.points.end(), x, x + 3);
  }
  if (vtkDataArray* time = points->GetFieldData()->GetArray("TimeValue");
      time != nullptr && time->GetNumberOfTuples() > 0)
    table.time = time->GetComponent(0, 0);
  vtkPointData& data = *points->GetPointData();
  for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
    vtkDataArray* array = data.GetArray(k);
    if (array == nullptr || array->GetName() == nullptr) continue;
    ParticleArray found{
        array->GetName(), array->GetNumberOfComponents(), array->GetDataTypeAsString(), {}};
    if (wanted && std::find(wanted->begin(), wanted->end(), found.name) == wanted->end()) continue;
    if (array->GetNumberOfTuples() != count)
      throw Error(file.string() + ": point array " + found.name + ": " +
                  std::to_string(array->GetNumberOfTuples()) + " values found, " +
                  std::to_string(count) + " expected");
    found.values.reserve(table.count * static_cast<std::size_t>(found.components));
    for (vtkIdType i = 0; i < count; ++i)
      for (int c = 0; c < found.components; ++c) found.values.push_back(array->GetComponent(i, c));
    table.arrays.push_back(std::move(found));
  }
  return table;
}

}  // namespace surge::compare
