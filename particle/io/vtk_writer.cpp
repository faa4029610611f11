#include "particle/io/vtk_writer.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <sstream>

#include "particle/io/atomic_file.hpp"
#include "particle/io/run_folder.hpp"
#include "particle/support/toml.hpp"

namespace surge {

namespace {

/// A VTK array that looks at the values without copying them. VTK does not write through it, but
/// its interface asks for a pointer to non-const.
template <class Array, class T>
vtkSmartPointer<Array> array_view(const char* name, const std::vector<T>& values, int components) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<T*>(values.data()), static_cast<vtkIdType>(values.size()), 1);
  return array;
}

/// One vertex cell per particle: ParaView draws and filters cells.
vtkSmartPointer<vtkCellArray> vertices(std::size_t count) {
  vtkNew<vtkTypeInt32Array> offsets;
  vtkNew<vtkTypeInt32Array> connectivity;
  const auto n = static_cast<vtkIdType>(count);
  offsets->SetNumberOfValues(n + 1);
  connectivity->SetNumberOfValues(n);
  for (vtkIdType i = 0; i <= n; ++i) offsets->SetValue(i, static_cast<vtkTypeInt32>(i));
  for (vtkIdType i = 0; i < n; ++i) connectivity->SetValue(i, static_cast<vtkTypeInt32>(i));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

vtkSmartPointer<vtkPolyData> poly_data(const Snapshot& s, const std::string& density_name) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(array_view<vtkDoubleArray>("Points", s.position, 3));
  data->SetPoints(points);
  data->SetVerts(vertices(s.size()));
  vtkPointData* fields = data->GetPointData();
  fields->AddArray(array_view<vtkFloatArray>("velocity", s.velocity, 3));
  fields->AddArray(array_view<vtkFloatArray>("pressure", s.pressure, 1));
  fields->AddArray(array_view<vtkFloatArray>(density_name.c_str(), s.density, 1));
  fields->AddArray(array_view<vtkUnsignedCharArray>("type", s.type, 1));
  fields->AddArray(array_view<vtkIntArray>("id", s.id, 1));
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(s.time);
  data->GetFieldData()->AddArray(time);
  return data;
}

}  // namespace

FrameWriter::FrameWriter(std::filesystem::path folder, std::string density_name,
                         std::vector<double> times)
    : folder_(std::move(folder)), density_name_(std::move(density_name)), times_(std::move(times)) {
  // A frame is written by one thread while the solver has the others: VTK's own would only wait.
  // (Its header that says so in words is no C++20.)
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);
  make_folder(folder_ / "frames");
  if (!times_.empty()) write_collection();
}

void FrameWriter::write(const Snapshot& snapshot) {
  const std::filesystem::path file = folder_ / frame_name(static_cast<long>(times_.size()));
  const auto data = poly_data(snapshot, density_name_);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // higher levels cost several times as much for a few percent
  // VTK itself says nothing when a disk is full.
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw Error(file.string() + ": found no way to encode the frame");
  write_file(file, writer->GetOutputString());
  times_.push_back(snapshot.time);
  write_collection();
}

void FrameWriter::write_collection() const {
  std::ostringstream pvd;
  pvd << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (std::size_t i = 0; i < times_.size(); ++i) {
    pvd << "    <DataSet timestep=\"" << number_text(times_[i]) << "\" file=\""
        << frame_name(static_cast<long>(i)) << "\"/>\n";
  }
  pvd << "  </Collection>\n</VTKFile>\n";
  write_file(folder_ / "particles.pvd", pvd.str());
}

}  // namespace surge
