#include "compare/read/legacy_vtk.hpp"

#include <gmock/gmock.h>
#include <vtkCellArray.h>
#include <vtkDataSetWriter.h>
#include <vtkPoints.h>

#include <filesystem>

#include "compare/read/readers.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// Particles with arrays of several kinds, as VTK itself writes them.
std::filesystem::path legacy_file(const TemporaryFolder& folder, bool binary) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkIntArray> type;
  type->SetName("Type");
  vtkNew<vtkFloatArray> velocity;
  velocity->SetName("Vel");
  velocity->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> density;
  density->SetName("Rho");
  for (const Vec3& x : testing::lattice({0, 0, 0}, {0.1, 0.1, 0}, 0.01)) {
    const vtkIdType id = points->InsertNextPoint(x.data());
    vertices->InsertNextCell(1, &id);
    type->InsertNextValue(static_cast<int>(id % 3));
    velocity->InsertNextTuple3(1.0, 2.0, 3.0);
    density->InsertNextValue(1000.0);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(type);
  data->GetPointData()->SetVectors(velocity);
  data->GetPointData()->AddArray(density);
  const auto file = folder / (binary ? "b.vtk" : "a.vtk");
  vtkNew<vtkDataSetWriter> writer;
  writer->SetFileName(file.c_str());
  binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
  writer->SetInputData(data);
  writer->Write();
  return file;
}

TEST(LegacyVtk, WholeFilesPass) {
  const TemporaryFolder folder;
  for (const bool binary : {false, true})
    EXPECT_EQ(testing::refusal_of([&] { check_legacy_vtk(legacy_file(folder, binary)); }), "");
}

TEST(LegacyVtk, NamesAreDecodedAndTheCaseOfWordsDoesNotMatter) {
  const TemporaryFolder folder;
  const auto file = testing::write_text(
      folder / "small.vtk",
      "# vtk DataFile Version 3.0\ntitle\nascii\ndataset polydata\npoints 2 Float\n0 0 0 1 0 0\n"
      "Point_Data 2\nscalars Particle%20Type int\nlookup_table default\n1 2\nfield FieldData 1\n"
      "Vel%3a1 1 2 double\n3 4\nmetadata\ninformation 0\n\n");
  const auto points = read_legacy_vtk(file);
  ASSERT_NE(points->GetPointData()->GetArray("Particle Type"), nullptr);
  EXPECT_EQ(points->GetPointData()->GetArray("Particle Type")->GetComponent(1, 0), 2.0);
  EXPECT_NE(points->GetPointData()->GetArray("Vel:1"), nullptr);
}

TEST(LegacyVtk, EveryCutIsFound) {
  const TemporaryFolder folder;
  for (const bool binary : {false, true}) {
    const auto file = legacy_file(folder, binary);
    const auto size = std::filesystem::file_size(file);
    // The last values may be followed by a line break only, which can go without loss. A cut
    // between two sections leaves a file that is whole without the later ones.
    std::size_t found = 0, tried = 0;
    for (std::uintmax_t left = size - 12; left > size / 3; left -= 13, ++tried) {
      std::filesystem::resize_file(file, left);
      const std::string error = testing::refusal_of([&] { check_legacy_vtk(file); });
      if (!error.empty()) {
        ++found;
        continue;
      }
      const std::string reader = testing::refusal_of(
          [&] { EXPECT_EQ(read_points(file, std::nullopt)->GetNumberOfPoints(), 100) << left; });
      if (!reader.empty()) ++found;
    }
    EXPECT_GT(10 * found, 9 * tried);
  }
}

TEST(LegacyVtk, OtherFilesAndBadCountsAreNamed) {
  const TemporaryFolder folder;
  const auto file = testing::write_text(folder / "x.vtk", "nonsense");
  EXPECT_THAT(error_of([&] { check_legacy_vtk(file); }), HasSubstr("not a legacy VTK file"));
  testing::write_text(file,
                      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS -5 float\n");
  EXPECT_THAT(error_of([&] { check_legacy_vtk(file); }), HasSubstr("POINTS: found \"-5\""));
}

}  // namespace
}  // namespace surge::compare
