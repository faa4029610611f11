#include <gmock/gmock.h>
#include <sys/stat.h>

#include "compare/read/readers.hpp"
#include "tests/compare/foreign_hdf5_writers.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using testing::foreign_facts;
using testing::ForeignFlow;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

// Files that announce what they do not hold, or lead elsewhere, are errors and nothing else.

TEST(HostileParticles, PipesAndDevicesAreNotRead) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "f_0.vtk").c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign_facts()); }),
              HasSubstr("neither manifest.json"));
  EXPECT_THAT(error_of([&] { (void)format_of(folder / "f_0.vtk", {}); }),
              HasSubstr("not a regular file"));
}

TEST(HostileParticles, CollectionLeadsNowhereElse) {
  const TemporaryFolder folder;
  write_text(folder / "secret_0.vtu", "x");
  for (const std::string name : {"../secret_0.vtu", "/etc/passwd", "a/../../secret_0.vtu"}) {
    const auto file = write_text(folder / "run/all.pvd",
                                 "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" "
                                 "file=\"" +
                                     name + "\"/></Collection></VTKFile>");
    EXPECT_THAT(error_of([&] { (void)list_series(file); }), HasSubstr("outside of the collection"));
  }
}

TEST(HostileParticles, CountsThatNoFileHoldsAreRefused) {
  const TemporaryFolder folder;
  testing::write_mps_basic(folder.path());
  const auto file = folder / "output_0000.vtu";
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [old, huge] :
       {std::pair<std::string, std::string>{"NumberOfComponents=\"1\"",
                                            "NumberOfComponents=\"2147483647\""},
        {"NumberOfPoints=\"302\"", "NumberOfPoints=\"99999999999999\""},
        {"NumberOfCells=\"302\"", "NumberOfCells=\"-1\""}}) {
    std::string damaged = text;
    damaged.replace(damaged.find(old), old.size(), huge);
    write_text(file, damaged);
    EXPECT_THAT(error_of([&] { (void)read_points(file, std::nullopt); }), HasSubstr("NumberOf"));
  }
  write_text(folder / "a.vtk",
             "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 99999999999 float\n");
  EXPECT_THAT(error_of([&] { (void)read_points(folder / "a.vtk", std::nullopt); }),
              HasSubstr("cut short"));
  write_text(folder / "dump.x",
             "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n99999999999\nITEM: ATOMS x y\n0 0\n");
  EXPECT_THAT(error_of([&] { (void)parts_of(folder / "dump.x", {}); }), HasSubstr("ends before"));
}

TEST(HostileParticles, NumberThatIsSplitIsFound) {
  const TemporaryFolder folder;
  testing::write_mps_basic(folder.path());
  const auto file = folder / "output_0001.vtu";
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto at = text.find("0.165");
  write_text(file, text.replace(at + 3, 1, " "));
  EXPECT_THAT(error_of([&] { (void)read_points(file, std::nullopt); }),
              HasSubstr("DataArray Points: 907 values found, 906 expected"));
}

TEST(HostileParticles, Hdf5LeadsNowhereElse) {
  const TemporaryFolder folder;
  testing::write_h5part(folder / "other.h5");
  {
    const testing::Hdf5Writer out(folder / "a.h5");
    out.group("inner");
    H5Lcreate_external("other.h5", "Step#0/x", out.id(), "x", H5P_DEFAULT, H5P_DEFAULT);
    out.values("y", {1.0, 2.0});
  }
  SourceOptions options = foreign_facts();
  options.position_array = {"x", "y"};
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "a.h5", options); }),
              HasSubstr("x: none found"));
}

TEST(HostileParticles, Hdf5ValuesThatWereNeverWrittenAreNone) {
  const TemporaryFolder folder;
  {
    const testing::Hdf5Writer out(folder / "a.h5");
    const hsize_t size = 1000000;
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    for (const char* name : {"x", "y"})
      const Hdf5Handle set(H5Dcreate2(out.id(), name, H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose);
  }
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "a.h5", foreign_facts()); }),
              HasSubstr("holds none"));
  write_text(folder / "b.h5", "\x89HDF\r\n\x1a\nnonsense");
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "b.h5", foreign_facts()); }),
              HasSubstr("cannot open it"));
}

TEST(HostileParticles, EveryCutOfAnHdf5FileIsFound) {
  const TemporaryFolder folder;
  testing::write_h5part(folder / "run.h5");
  SourceOptions options = foreign_facts();
  options.groups = {"Step#*"};
  options.type_array = "kind";
  options.type_required = true;
  options.fluid_type = 4;
  const auto size = std::filesystem::file_size(folder / "run.h5");
  for (std::uintmax_t left = size - 1; left > size / 8; left = left * 7 / 8) {
    std::filesystem::resize_file(folder / "run.h5", left);
    EXPECT_NE(testing::refusal_of([&] {
                auto run = open_run(folder / "run.h5", options);
                (void)measure_front(run, testing::foreign_front());
              }),
              "")
        << left;
  }
}

}  // namespace
}  // namespace surge::compare
