#include "compare/read/isolated.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <limits>

#include "compare/read/readers.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

TEST(Isolated, ResultsAreThoseOfTheChild) {
  ParticleTable table;
  table.count = 2;
  table.points = {0.1, 0.2, 0.3, -1.0 / 3.0, 0.0, std::numeric_limits<double>::infinity()};
  table.arrays = {{"p", 1, "float", {1.0, 2.0}}, {"none", 3, "int32", {}}};
  table.time = 0.1;
  table.notes = {"a note", ""};
  const ParticleTable read = table_in_child("file", [&] { return table; });
  EXPECT_EQ(read.count, 2U);
  EXPECT_EQ(read.points, table.points);
  ASSERT_EQ(read.arrays.size(), 2U);
  EXPECT_EQ(read.arrays[0].values, table.arrays[0].values);
  EXPECT_EQ(read.arrays[1].name, "none");
  EXPECT_EQ(read.arrays[1].components, 3);
  EXPECT_EQ(read.arrays[1].type, "int32");
  EXPECT_EQ(read.time, 0.1);
  EXPECT_EQ(read.notes, table.notes);
  FilePart part;
  part.step = -7;
  part.end = 1ULL << 40;
  part.star = "000";
  const auto parts = parts_in_child("file", [&] { return std::vector<FilePart>{part, {}}; });
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].step, -7);
  EXPECT_EQ(parts[0].time, std::nullopt);
  EXPECT_EQ(parts[0].end, 1ULL << 40);
  EXPECT_EQ(parts[0].star, "000");
}

TEST(Isolated, WhatEndsTheChildIsAnErrorHere) {
  const auto said = [](const std::function<std::string()>& work) {
    return error_of([&] { (void)in_child("a.h5", work); });
  };
  EXPECT_THAT(said([]() -> std::string { throw Error("b.h5: x: none found"); }),
              HasSubstr("b.h5: x: none found"));
  EXPECT_THAT(said([]() -> std::string { throw std::bad_alloc(); }),
              HasSubstr("a.h5: cannot be read: std::bad_alloc"));
  EXPECT_THAT(said([]() -> std::string {
                (void)raise(SIGKILL);
                return "";
              }),
              HasSubstr("a.h5: the library that reads it broke down (signal 9)"));
  EXPECT_EQ(in_child("a.h5", [] { return std::string(); }), "");
}

/// Found by fuzzing: VTK's reader ends the program on each of these.
TEST(Isolated, XmlThatEndsVtkIsRefused) {
  const TemporaryFolder folder;
  const auto file = write_text(
      folder / "a.vtp",
      "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><FieldData><DataArray "
      "type=\"Flolt64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.1"
      "</DataArray></FieldData><Piece NumberOfPoints=\"1\" NumberOfVerts=\"0\"><Points>"
      "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray>"
      "</Points></Piece></PolyData></VTKFile>");
  EXPECT_THAT(error_of([&] { (void)read_vtk(file, std::nullopt); }),
              HasSubstr("a.vtp: DataArray: type: found \"Flolt64\""));
  EXPECT_THAT(error_of([&] { (void)stated_time(file); }), HasSubstr("Flolt64"));
}

}  // namespace
}  // namespace surge::compare
