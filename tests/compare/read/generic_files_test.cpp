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

TEST(GenericFiles, ParallelFilesAreOneSeriesWithTheirPiecesLeftOut) {
  const TemporaryFolder folder;
  for (int i = 0; i < ForeignFlow::frames; ++i) {
    const auto points = ForeignFlow().fluid(i);
    const std::string stem = "w_" + std::to_string(i);
    const std::vector<Vec3> first(points.begin(), points.begin() + 90);
    const std::vector<Vec3> second(points.begin() + 90, points.end());
    testing::write_vtu(folder / (stem + "_0.vtu"), first, "", "Time", 0.02 * i);
    testing::write_vtu(folder / (stem + "_1.vtu"), second, "", "Time", 0.02 * i);
    write_text(folder / (stem + ".pvtu"),
               "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid GhostLevel=\"0\"><Piece "
               "Source=\"" +
                   stem + "_0.vtu\"/><Piece Source=\"" + stem +
                   "_1.vtu\"/></PUnstructuredGrid></VTKFile>");
  }
  auto run = open_run(folder.path(), foreign_facts());
  const FrontHistory front = measure_front(run, testing::foreign_front());
  ASSERT_EQ(front.size(), 6U);
  EXPECT_NEAR(front[5].position.value(), ForeignFlow::edge(5), 1e-9);
  EXPECT_NEAR(front[5].time.value(), 0.1, 1e-12);
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
