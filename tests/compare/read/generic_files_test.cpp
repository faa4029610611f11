#include <gmock/gmock.h>

#include "tests/compare/foreign_hdf5_writers.hpp"
#include "tests/compare/foreign_text_writers.hpp"
#include "tests/compare/foreign_vtk_writers.hpp"

namespace surge::compare {
namespace {

using ::testing::Contains;
using testing::error_of;
using testing::expect_known_front;
using testing::foreign_facts;
using testing::ForeignFlow;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

// Files of no known program, in the forms that people's own scripts and ParaView write.

TEST(GenericFiles, TablesThatParaViewSavesAreRead) {
  const TemporaryFolder folder;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = ForeignFlow().particles(i, 0, std::nullopt);
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < p.position.size(); ++k)
      rows.push_back({0.5, -0.25, 0.0, p.pressure[k], p.position[k][0], p.position[k][1], 0.0});
    write_text(folder / ("spread_" + std::to_string(i) + ".csv"),
               testing::csv_text({"\"v:0\"", "\"v:1\"", "\"v:2\"", "\"p\"", "\"Points:0\"",
                                  "\"Points:1\"", "\"Points:2\""},
                                 rows, ","));
  }
  SourceOptions options = foreign_facts();
  options.time_step = Seconds(0.02);
  options.velocity_array = {"v:0", "v:1", "v:2"};
  options.pressure_array = "p";
  (void)expect_known_front(folder.path(), options);
}

TEST(GenericFiles, Hdf5WithVectorsAndATimeIsRead) {
  const TemporaryFolder folder;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = ForeignFlow().particles(i, 0, std::nullopt);
    const testing::Hdf5Writer out(folder / ("f_" + std::to_string(i) + ".h5"));
    std::vector<double> position, velocity;
    for (std::size_t k = 0; k < p.position.size(); ++k) {
      position.insert(position.end(), p.position[k].begin(), p.position[k].end());
      velocity.insert(velocity.end(), p.velocity[k].begin(), p.velocity[k].end());
    }
    out.values("positions", position, 3);
    out.values("velocity", velocity, 3);
    out.values("pressure", p.pressure);
    out.attribute("/", "time", i * ForeignFlow::interval);
  }
  (void)expect_known_front(folder.path(), foreign_facts());
}

/// The same column 0.05 m deep, z upwards.
std::vector<Vec3> deep(int i) {
  std::vector<Vec3> points;
  for (int layer = 0; layer < 5; ++layer)
    for (const Vec3& x : ForeignFlow().fluid(i))
      points.push_back({x[0], 0.01 * (layer + 0.5), x[1]});
  return points;
}

TEST(GenericFiles, ThreeDimensionsWithZUpwardsAreReadByAxesOrVertical) {
  const TemporaryFolder folder;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    std::string text = "x y z\n";
    for (const Vec3& x : deep(i))
      text += testing::digits17(x[0]) + " " + testing::digits17(x[1]) + " " +
              testing::digits17(x[2]) + "\n";
    write_text(folder / ("f_" + std::to_string(i) + ".txt"), text);
  }
  const auto front = [&](const std::string& key, const std::vector<std::string>& words) {
    SourceOptions options = foreign_facts();
    options.time_step = Seconds(0.02);
    if (!key.empty()) set_source_option(options, key, words, key, ".");
    auto run = open_run(folder.path(), options);
    EXPECT_EQ(run.physics.dimension, 3);
    return measure_front(run, testing::foreign_front()).back().position.value();
  };
  EXPECT_NEAR(front("axes", {"x", "z"}), ForeignFlow::edge(5), 1e-9);
  EXPECT_NEAR(front("vertical", {"z"}), ForeignFlow::edge(5), 1e-9);
  // Without a word y would be up; the water falls along z.
  EXPECT_THAT(error_of([&] { (void)front("", {}); }), HasSubstr("cannot rise"));
}

TEST(GenericFiles, FieldsThatAreNotThereAreToldWhereTheyAreAskedFor) {
  const TemporaryFolder folder;
  testing::write_parallel(folder.path());
  auto run = open_run(folder.path(), foreign_facts());
  EXPECT_TRUE(run.frames->notices().empty());
  const auto frame =
      std::get<ParticleFrame>(run.frames->read(1, {.pressure = true, .velocity = true}));
  EXPECT_EQ(frame.position.size(), 200U);
  EXPECT_TRUE(frame.pressure.empty());
  EXPECT_TRUE(frame.velocity.empty());
  ASSERT_EQ(run.frames->notices().size(), 2U);
  EXPECT_THAT(run.frames->notices()[0], HasSubstr("no pressure by a usual name"));
  // One that is named must be there.
  SourceOptions options = foreign_facts();
  set_source_option(options, "pressure_array", std::vector<std::string>{"press"}, "", ".");
  EXPECT_THAT(
      error_of([&] { (void)open_run(folder.path(), options).frames->read(0, {.pressure = true}); }),
      HasSubstr("press"));
}

TEST(GenericFiles, ParallelFilesAreOneSeriesWithTheirPiecesLeftOut) {
  const TemporaryFolder folder;
  testing::write_parallel(folder.path());
  auto run = open_run(folder.path(), foreign_facts());
  const FrontHistory front = measure_front(run, testing::foreign_front());
  ASSERT_EQ(front.size(), 6U);
  EXPECT_NEAR(front[5].position.value(), ForeignFlow::edge(5), 1e-9);
  EXPECT_NEAR(front[5].time.value(), 0.1, 1e-12);
}

TEST(GenericFiles, PointsOfOtherPiecesAreLeftOut) {
  const TemporaryFolder folder;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto p = ForeignFlow().particles(i, 0, std::nullopt);
    const std::string stem = "w_" + std::to_string(i);
    for (const std::size_t piece : {0U, 1U}) {
      // Each piece holds ten particles of the other one besides its own.
      const std::size_t first = piece == 0 ? 0 : 80, last = piece == 0 ? 100 : 200;
      std::vector<Vec3> position, velocity;
      std::vector<double> pressure;
      std::vector<int> ghost;
      for (std::size_t k = first; k < last; ++k) {
        position.push_back(p.position[k]);
        velocity.push_back(p.velocity[k]);
        pressure.push_back(p.pressure[k]);
        ghost.push_back((piece == 0) == (k < 90) ? 0 : 1);
      }
      testing::write_vtu(folder / (stem + "_" + std::to_string(piece) + ".vtu"), position,
                         testing::data_array("velocity", "Float64", 3, velocity) +
                             testing::data_array("pressure", "Float64", 1, pressure) +
                             testing::data_array("vtkGhostType", "UInt8", 1, ghost),
                         "Time", i * ForeignFlow::interval);
    }
    write_text(folder / (stem + ".pvtu"),
               "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid GhostLevel=\"1\"><Piece "
               "Source=\"" +
                   stem + "_0.vtu\"/><Piece Source=\"" + stem +
                   "_1.vtu\"/></PUnstructuredGrid></VTKFile>");
  }
  SourceOptions options = foreign_facts();
  EXPECT_THAT(expect_known_front(folder.path(), options),
              Contains(HasSubstr("vtkGhostType marks as another piece's")));
}

TEST(GenericFiles, CollectionWithWallsAsPartsIsReadByTheirNames) {
  const TemporaryFolder folder;
  std::string list;
  for (int i = 0; i < ForeignFlow::frames; ++i)
    for (const std::string body : {"fluid", "wall"}) {
      const std::string name = body + "_" + std::to_string(i) + ".vtu";
      const ForeignFlow flow;
      testing::write_vtu(folder / name, body == "wall" ? flow.walls() : flow.fluid(i), "", "",
                         std::nullopt);
      list += "<DataSet timestep=\"" + testing::digits17(0.02 * i) + "\" part=\"" +
              (body == "wall" ? "1" : "0") + "\" file=\"" + name + "\"/>";
    }
  write_text(folder / "all.pvd",
             "<VTKFile type=\"Collection\"><Collection>" + list + "</Collection></VTKFile>");
  auto run = open_run(folder / "all.pvd", foreign_facts());
  EXPECT_THAT(run.notices, Contains(HasSubstr("no fluid in wall_*.vtu")));
  const FrontHistory front = measure_front(run, testing::foreign_front());
  EXPECT_NEAR(front.back().position.value(), ForeignFlow::edge(5), 1e-9);
}

}  // namespace
}  // namespace surge::compare
