#include <gmock/gmock.h>

#include "compare/read/readers.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using ::testing::ElementsAre;
using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;
using testing::write_vtp;

const std::vector<Vec3> column = testing::lattice({0, 0, 0}, {0.1, 0.2, 0}, 0.01);

std::string data_set(const std::string& time, const std::string& file,
                     const std::string& part = "0") {
  return "<DataSet timestep=\"" + time + "\" part=\"" + part + "\" file=\"" + file + "\"/>";
}

class Collection {
 public:
  Collection() {
    for (const char* name : {"a_0.vtp", "a_1.vtp", "sub dir/a_2.vtp"})
      write_vtp(folder_ / name, column, {}, "x");
  }
  [[nodiscard]] std::filesystem::path write(const std::string& sets) const {
    return write_text(folder_ / "all.pvd",
                      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">"
                      "<Collection>" +
                          sets + "</Collection></VTKFile>");
  }
  [[nodiscard]] std::string refused(const std::string& sets) const {
    const auto file = write(sets);
    return error_of([&] { (void)list_series(file); });
  }

 private:
  TemporaryFolder folder_;
};

TEST(Collection, TimesAndFilesAreThoseWritten) {
  const Collection collection;
  const auto entries =
      list_series(collection.write(data_set("0", "a_0.vtp") + data_set("5e-2", "a_1.vtp") +
                                   data_set("0.1", "sub dir\\a_2.vtp")));
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[1].time->value(), 0.05);
  EXPECT_EQ(entries[2].files[0].filename(), "a_2.vtp");
}

TEST(Collection, PartsOfOneTimeBelongTogether) {
  const Collection collection;
  const auto entries =
      list_series(collection.write(data_set("0", "a_0.vtp", "0") + data_set("0", "a_1.vtp", "1")));
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].files.size(), 2U);
}

TEST(Collection, GroupsOfOneTimeBelongTogether) {
  const Collection collection;
  const auto in_group = [](const std::string& group, const std::string& file) {
    return "<DataSet timestep='0' group='" + group + "' file='" + file + "'/>";
  };
  const auto entries =
      list_series(collection.write(in_group("0", "a_0.vtp") + in_group("1", "a_1.vtp")));
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].files.size(), 2U);
  EXPECT_THAT(collection.refused(in_group("0", "a_0.vtp") + in_group("0", "a_1.vtp")),
              HasSubstr("second file of part 0"));
}

TEST(Collection, TwoRunsInOneAreRefused) {
  const Collection collection;
  EXPECT_THAT(collection.refused(data_set("0", "a_0.vtp") + data_set("0.1", "a_1.vtp") +
                                 data_set("0", "a_0.vtp")),
              HasSubstr("increasing times"));
  EXPECT_THAT(collection.refused(data_set("0", "a_0.vtp") + data_set("0", "a_1.vtp")),
              HasSubstr("second file of part 0"));
}

TEST(Collection, TimesThatAreNoNumbersAreRefused) {
  const Collection collection;
  for (const char* time : {"5.0D-02", "nan", "inf", "1e400", "0.1s", "0,1"})
    EXPECT_THAT(collection.refused(data_set(time, "a_0.vtp")), HasSubstr("timestep: found"))
        << time;
}

TEST(FileSeries, AreRead) {
  const TemporaryFolder folder;
  write_vtp(folder / "a_0.vtp", column, {}, "x");
  write_vtp(folder / "a_1.vtp", column, {}, "x");
  const auto file = write_text(folder / "a.vtp.series",
                               R"({"file-series-version": "1.0", "files": [
      {"name": "a_0.vtp", "time": 0.0}, {"name": "a_1.vtp", "time": 0.05}]})");
  EXPECT_EQ(list_series(file)[1].time->value(), 0.05);
  write_text(file,
             R"({"files": [{"name": "a_0.vtp", "time": 0.1}, {"name": "a_1.vtp", "time": 0}]})");
  EXPECT_THAT(error_of([&] { (void)list_series(file); }), HasSubstr("increasing times"));
  write_text(file, R"({"files": [{"name": "a_0.vtp"}]})");
  EXPECT_THAT(error_of([&] { (void)list_series(file); }), HasSubstr("files.0"));
}

TEST(ParallelFiles, AreTheirPieces) {
  const TemporaryFolder folder;
  write_vtp(folder / "a_0.vtp", column, {}, "x");
  write_text(folder / "a.pvtp",
             "<VTKFile type=\"PPolyData\"><PPolyData GhostLevel=\"0\"><Piece "
             "Source=\"a_0.vtp\"/></PPolyData></VTKFile>");
  const auto file =
      write_text(folder / "all.pvd", "<VTKFile type=\"Collection\"><Collection>" +
                                         data_set("0", "a.pvtp") + "</Collection></VTKFile>");
  EXPECT_EQ(list_series(file)[0].files[0].filename(), "a_0.vtp");
}

SourceOptions stepped(double step) {
  SourceOptions options;
  options.time_step = Seconds(step);
  return options;
}

std::vector<double> values(const std::vector<Seconds>& times) {
  std::vector<double> out;
  for (const Seconds t : times) out.push_back(std::round(t.value() * 1e6) / 1e6);
  return out;
}

TEST(NumberedFiles, NumbersAreStepsAndGapsAreKeptAndTold) {
  const TemporaryFolder folder;
  for (const int i : {2, 3, 5, 6})
    write_vtp(folder / ("f_" + std::to_string(i) + ".vtp"), column, {}, "x");
  const auto reader = open_particle_series(list_series(folder.path()), stepped(0.05));
  EXPECT_THAT(values(reader->times()), ElementsAre(0.1, 0.15, 0.25, 0.3));
  ASSERT_EQ(reader->notices().size(), 1U);
  EXPECT_THAT(reader->notices()[0], HasSubstr("f_3.vtp and f_5.vtp"));
}

TEST(ParticleFiles, TimeIsFoundUnderItsUsualNames) {
  for (const char* name : {"TimeValue", "TIME", "Time", "time"}) {
    const TemporaryFolder folder;
    const auto file = write_text(
        folder / "f_0.vtu",
        "<VTKFile type='UnstructuredGrid' version='0.1'><UnstructuredGrid><FieldData><DataArray "
        "type='Float64' Name='" +
            std::string(name) +
            "' NumberOfTuples='1' format='ascii'>0.25</DataArray></FieldData><Piece "
            "NumberOfPoints='1' NumberOfCells='0'><Points><DataArray type='Float64' "
            "NumberOfComponents='3' format='ascii'>0 0 0</DataArray></Points><Cells><DataArray "
            "type='Int32' Name='connectivity' format='ascii'/><DataArray type='Int32' "
            "Name='offsets' format='ascii'/><DataArray type='UInt8' Name='types' "
            "format='ascii'/></Cells></Piece></UnstructuredGrid></VTKFile>");
    EXPECT_EQ(stated_time(file)->value(), 0.25) << name;
  }
}

TEST(ParticleFiles, MeshIsNoParticleFile) {
  const TemporaryFolder folder;
  const auto file = write_text(folder / "m_0.vtk",
                               "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                               "POINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nCELLS 1 5\n4 0 1 2 3\n"
                               "CELL_TYPES 1\n9\n");
  EXPECT_THAT(error_of([&] { (void)read_points(file, std::nullopt); }),
              HasSubstr("1 cells with an extent"));
}

TEST(ParticleFiles, ManyParticlesThatAreNotFiniteAreRefusedFewAreCounted) {
  for (const std::size_t lost : {1U, 100U}) {
    const TemporaryFolder folder;
    std::vector<Vec3> points = column;
    for (std::size_t i = 0; i < lost; ++i) points[i][0] = std::nan("");
    write_vtp(folder / "f_0.vtp", column, {}, "x");
    write_vtp(folder / "f_1.vtp", points, {}, "x");
    const auto reader = open_particle_series(list_series(folder.path()), stepped(0.05));
    if (lost == 1) {
      EXPECT_EQ(std::get<ParticleFrame>(reader->read(1, {})).nonfinite, 1U);
      EXPECT_THAT(reader->notices().at(0), HasSubstr("up to 1 in 1 frames"));
    } else {
      EXPECT_THAT(error_of([&] { (void)reader->read(1, {}); }),
                  HasSubstr("100 of 200 fluid particles are not finite"));
    }
  }
}

}  // namespace
}  // namespace surge::compare
