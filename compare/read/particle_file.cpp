#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <new>

#include "compare/read/delimited.hpp"
#include "compare/read/isolated.hpp"
#include "compare/read/legacy_vtk.hpp"
#include "compare/read/particle_table.hpp"
#include "compare/read/readers.hpp"
#include "compare/read/xml_vtk.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// What marks the points of a piece that belong to another one.
constexpr const char* ghost_arrays[] = {"vtkGhostType", "vtkGhostLevels"};

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
    for (const char* name : ghost_arrays)
      if (selection->ArrayExists(name)) selection->EnableArray(name);
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

namespace {

/// The XML files, which VTK reads.
bool is_xml(const fs::path& file) {
  return file.extension() == ".vtp" || file.extension() == ".vtu";
}

std::optional<Seconds> time_in(const fs::path& file, const std::string& name) {
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

/// Leaves out the points that another piece of a parallel file holds as its own.
void leave_out_ghosts(ParticleTable& table, vtkPointData& data) {
  for (const char* name : ghost_arrays) {
    vtkDataArray* ghost = data.GetArray(name);
    if (ghost == nullptr || ghost->GetNumberOfTuples() != static_cast<vtkIdType>(table.count))
      continue;
    std::vector<bool> own(table.count);
    for (std::size_t i = 0; i < table.count; ++i)
      own[i] = ghost->GetComponent(static_cast<vtkIdType>(i), 0) == 0.0;
    const auto count = static_cast<std::size_t>(std::count(own.begin(), own.end(), true));
    if (count == table.count) continue;
    const auto keep = [&](std::vector<double>& values, std::size_t components) {
      std::vector<double> kept;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (own[i / components]) kept.push_back(values[i]);
      values = std::move(kept);
    };
    keep(table.points, 3);
    for (ParticleArray& array : table.arrays)
      keep(array.values, static_cast<std::size_t>(array.components));
    table.count = count;
    table.notes.push_back(std::string("points that ") + name +
                          " marks as another piece's are left out");
    return;
  }
}

void add_text(ParticleTable& table, vtkStringArray& array, const ArrayNames& wanted,
              const fs::path& file) {
  if (array.GetName() == nullptr || array.GetNumberOfComponents() != 1) return;
  ParticleArray found{array.GetName(), 1, "text", {}};
  if (wanted && std::find(wanted->begin(), wanted->end(), found.name) == wanted->end()) return;
  if (array.GetNumberOfTuples() != static_cast<vtkIdType>(table.count))
    throw Error(file.string() + ": point array " + found.name + ": " +
                std::to_string(array.GetNumberOfTuples()) + " words found, " +
                std::to_string(table.count) + " expected");
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) found.add_word(array.GetValue(i));
  // Types such as "1" and "2" are numbers, however they are stored.
  std::vector<double> numbers;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    if (const auto number = number_in(std::string(array.GetValue(i)))) numbers.push_back(*number);
  if (numbers.size() == found.values.size()) found = {found.name, 1, "number", std::move(numbers)};
  table.arrays.push_back(std::move(found));
}

ParticleTable table_in(const fs::path& file, const ArrayNames& wanted) {
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
    if (auto* text = vtkStringArray::SafeDownCast(data.GetAbstractArray(k))) {
      add_text(table, *text, wanted, file);
      continue;
    }
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
  leave_out_ghosts(table, data);
  return table;
}

}  // namespace

std::optional<Seconds> stated_time(const fs::path& file, const std::string& name) {
  require_regular(file);
  const auto read = [&] {
    FilePart part;
    if (const auto time = time_in(file, name)) part.time = time->value();
    return std::vector<FilePart>{part};
  };
  const FilePart part = is_xml(file) ? parts_in_child(file, read)[0] : read()[0];
  return part.time ? std::optional(Seconds(*part.time)) : std::nullopt;
}

std::vector<FilePart> vtk_parts(const fs::path& file, const SourceOptions& options) {
  FilePart part;
  if (const auto time = stated_time(file, options.time_array)) part.time = time->value();
  return {part};
}

ParticleTable read_vtk_here(const fs::path& file, const ArrayNames& wanted) {
  require_regular(file);
  return table_in(file, wanted);
}

ParticleTable read_vtk(const fs::path& file, const ArrayNames& wanted) {
  require_regular(file);
  const auto read = [&] { return table_in(file, wanted); };
  return is_xml(file) ? table_in_child(file, read) : read();
}

}  // namespace surge::compare
