#include "particle/io/vtk_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include "particle/support/error.hpp"
#include "tests/case/case_fixture.hpp"
#include "tests/places.hpp"

namespace surge {
namespace {

/// Three particles whose ids are out of order.
Particles<2> three_particles() {
  Particles<2> p;
  p.resize(3);
  p.id = {2, 0, 1};
  p.type = {ParticleType::dummy, ParticleType::fluid, ParticleType::wall};
  p.x[0] = {2.5, 0.5, 1.5};
  p.x[1] = {-2.0, 0.0, -1.0};
  p.v[0] = {0.0, 3.0, 0.0};
  p.v[1] = {0.0, 4.0, 0.0};
  p.pressure = {20.0, 0.0, 10.0};
  p.density = {1002.0, 1000.0, 1001.0};
  return p;
}

TEST(FrameWriter, FramesReadBackWithVtk) {
  const tests::TemporaryFolder folder;
  FrameWriter writer(folder.path(), "density");
  writer.write(take_snapshot<2>(three_particles(), 0.125));

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder.path() / "frames/frame_00000.vtp").c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfPoints(), 3);
  EXPECT_EQ(data->GetNumberOfVerts(), 3);
  vtkPointData* fields = data->GetPointData();
  EXPECT_EQ(fields->GetNumberOfArrays(), 5);
  const auto value = [&](const char* name, vtkIdType i, int component) {
    vtkDataArray* array = fields->GetArray(name);
    return array == nullptr ? std::nan("") : array->GetComponent(i, component);
  };
  for (vtkIdType i = 0; i < 3; ++i) {  // in the order of ids
    EXPECT_EQ(value("id", i, 0), static_cast<double>(i));
    EXPECT_EQ(value("type", i, 0), static_cast<double>(i));
    EXPECT_EQ(value("pressure", i, 0), 10.0 * static_cast<double>(i));
    EXPECT_EQ(value("density", i, 0), 1000.0 + static_cast<double>(i));
    EXPECT_EQ(data->GetPoint(i)[0], 0.5 + static_cast<double>(i));
    EXPECT_EQ(data->GetPoint(i)[1], -static_cast<double>(i));
    EXPECT_EQ(data->GetPoint(i)[2], 0.0);
  }
  ASSERT_NE(fields->GetArray("velocity"), nullptr);
  EXPECT_EQ(fields->GetArray("velocity")->GetNumberOfComponents(), 3);
  EXPECT_EQ(value("velocity", 0, 1), 4.0);
  ASSERT_NE(data->GetFieldData()->GetArray("TimeValue"), nullptr);
  EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.125);
}

TEST(FrameWriter, CollectionListsEveryFrameAfterEachWrite) {
  const tests::TemporaryFolder folder;
  FrameWriter writer(folder.path(), "number_density");
  for (const double time : {0.0, 0.005}) writer.write(take_snapshot<2>(three_particles(), time));
  const std::string pvd = test::read_text(folder.path() / "particles.pvd");
  EXPECT_THAT(pvd, testing::HasSubstr("timestep=\"0\" file=\"frames/frame_00000.vtp\""));
  EXPECT_THAT(pvd, testing::HasSubstr("timestep=\"0.005\" file=\"frames/frame_00001.vtp\""));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    EXPECT_NE(entry.path().extension(), ".tmp");
  }
}

TEST(FrameWriter, SaysWhereItCannotWrite) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder.path() / "frames") << "a file in the way";
  EXPECT_THROW(FrameWriter(folder.path(), "density"), Error);
}

TEST(Snapshot, CountsNonfiniteValues) {
  Particles<2> p = three_particles();
  EXPECT_EQ(count_nonfinite(p), 0U);
  p.x[1][0] = std::nan("");
  p.v[0][2] = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(count_nonfinite(p), 2U);
  // So many that threads share the work: first, last and in between.
  Field many(200001, 1.0);
  for (const std::size_t i : {std::size_t{0}, std::size_t{100000}, many.size() - 1})
    many[i] = std::nan("");
  EXPECT_EQ(count_nonfinite(many), 3U);
}

TEST(FrameWriter, ParticlesFarFromTheOriginKeepTheirPlaces) {
  const tests::TemporaryFolder folder;
  Particles<2> p = three_particles();
  p.x[0] = {1e6 + 0.002, 1e6, 1e6 + 0.001};
  FrameWriter writer(folder.path(), "density");
  writer.write(take_snapshot<2>(p, 0.0));
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder.path() / "frames/frame_00000.vtp").c_str());
  reader->Update();
  for (vtkIdType i = 0; i < 3; ++i) {
    std::array<double, 3> x{};
    reader->GetOutput()->GetPoint(i, x.data());
    EXPECT_DOUBLE_EQ(x[0], 1e6 + 0.001 * static_cast<double>(i));
  }
}

}  // namespace
}  // namespace surge
