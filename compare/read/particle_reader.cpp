#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataSetReader.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>

#include "compare/read/readers.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

template <class Reader>
vtkSmartPointer<vtkPointSet> read_xml(const fs::path& file, const Names& arrays) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->UpdateInformation();
  reader->GetCellDataArraySelection()->DisableAllArrays();
  vtkDataArraySelection* selection = reader->GetPointDataArraySelection();
  selection->DisableAllArrays();
  for (const std::string& name : arrays) {
    if (selection->ArrayExists(name.c_str())) selection->EnableArray(name.c_str());
  }
  reader->Update();
  return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPointSet> read_legacy(const fs::path& file) {
  vtkNew<vtkDataSetReader> reader;
  reader->SetFileName(file.c_str());
  reader->ReadAllFieldsOn();
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->Update();
  return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0));
}

/// The points of a file with those of the named arrays that it has.
vtkSmartPointer<vtkPointSet> read_points(const fs::path& file, const Names& arrays) {
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
  return points;
}

vtkDataArray& require_array(vtkPointSet& points, const std::string& name, int components,
                            const fs::path& file) {
  vtkDataArray* array = points.GetPointData()->GetArray(name.c_str());
  if (!array) throw Error(file.string() + ": point array " + name + ": none found, one expected");
  if (array->GetNumberOfComponents() != components ||
      array->GetNumberOfTuples() != points.GetNumberOfPoints()) {
    throw Error(file.string() + ": point array " + name + ": " +
                std::to_string(array->GetNumberOfComponents()) + " components and " +
                std::to_string(array->GetNumberOfTuples()) + " values found, " +
                std::to_string(components) + " and " + std::to_string(points.GetNumberOfPoints()) +
                " expected");
  }
  return *array;
}

std::optional<Seconds> stated_time(const fs::path& file) {
  const vtkSmartPointer<vtkPointSet> points = read_points(file, {});
  for (const char* name : {"TimeValue", "TIME"}) {
    vtkDataArray* array = points->GetFieldData()->GetArray(name);
    if (array && array->GetNumberOfTuples() > 0) return Seconds(array->GetComponent(0, 0));
  }
  return std::nullopt;
}

class ParticleReader : public FrameReader {
 public:
  ParticleReader(std::vector<SeriesEntry> entries, const SourceOptions& options)
      : entries_(std::move(entries)), options_(options) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      times_.push_back(time_of_entry(i));
      if (!times_[i].is_finite() || (i > 0 && times_[i] <= times_[i - 1])) {
        throw Error(entries_[i].files[0].string() + ": time " + std::to_string(times_[i].value()) +
                    " s found, a later one than of the file before expected");
      }
    }
  }

  [[nodiscard]] const std::vector<Seconds>& times() const override { return times_; }

  [[nodiscard]] Frame read(std::size_t index, Fields fields) override {
    ParticleFrame frame;
    frame.time = times_.at(index);
    for (const fs::path& file : entries_[index].files) append(frame, file, fields);
    if (frame.position.empty()) {
      throw Error(entries_[index].files[0].string() + ": no fluid particle found (array " +
                  options_.type_array + ", value " + std::to_string(options_.fluid_type) +
                  "), at least one expected");
    }
    return frame;
  }

 private:
  [[nodiscard]] Seconds time_of_entry(std::size_t i) const {
    if (options_.time_step) return static_cast<double>(i) * *options_.time_step;
    if (entries_[i].time) return *entries_[i].time;
    const auto time = stated_time(entries_[i].files[0]);
    if (!time) {
      throw Error(entries_[i].files[0].string() +
                  ": no TimeValue found, one in each file or --time-step expected");
    }
    return *time;
  }

  void append(ParticleFrame& frame, const fs::path& file, Fields fields) const {
    Names names{options_.type_array};
    if (fields.pressure) names.push_back(options_.pressure_array);
    if (fields.velocity) names.push_back(options_.velocity_array);
    const vtkSmartPointer<vtkPointSet> points = read_points(file, names);
    vtkDataArray* type = nullptr;
    if (options_.type_required || points->GetPointData()->HasArray(options_.type_array.c_str())) {
      type = &require_array(*points, options_.type_array, 1, file);
    }
    vtkDataArray* pressure =
        fields.pressure ? &require_array(*points, options_.pressure_array, 1, file) : nullptr;
    vtkDataArray* velocity =
        fields.velocity ? &require_array(*points, options_.velocity_array, 3, file) : nullptr;
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
      if (type && static_cast<int>(std::lround(type->GetComponent(i, 0))) != options_.fluid_type)
        continue;
      Vec3 x;
      points->GetPoint(i, x.data());
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) {
        ++frame.nonfinite;
        continue;
      }
      frame.position.push_back(x);
      if (pressure) frame.pressure.push_back(pressure->GetComponent(i, 0));
      if (velocity) {
        frame.velocity.push_back({velocity->GetComponent(i, 0), velocity->GetComponent(i, 1),
                                  velocity->GetComponent(i, 2)});
      }
    }
  }

  std::vector<SeriesEntry> entries_;
  SourceOptions options_;
  std::vector<Seconds> times_;
};

}  // namespace

std::unique_ptr<FrameReader> open_particle_series(std::vector<SeriesEntry> entries,
                                                  const SourceOptions& options) {
  return std::make_unique<ParticleReader>(std::move(entries), options);
}

}  // namespace surge::compare
