#include "foam_cases/mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "foam_cases/divisions.hpp"
#include "foam_cases/size.hpp"
#include "tests/foam/foam_fixture.hpp"

namespace surge::foam {
namespace {

using test::made;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

/// The small case in 3D: z is its depth.
std::string deep_case() {
  std::string text = test::small_case;
  const auto put = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  put("dimension = 2", "dimension = 3");
  put("-9.81]", "-9.81, 0.0]");
  put("lower = [0.0, 0.0]", "lower = [0.0, 0.0, 0.0]");
  put("lower = [0.3, 0.0]", "lower = [0.3, 0.0, 0.05]");
  put("upper = [0.4, 0.4]", "upper = [0.4, 0.4, 0.2]");
  put("upper = [0.1, 0.2]", "upper = [0.1, 0.2, 0.2]");
  put("upper = [0.4, 0.1]", "upper = [0.4, 0.1, 0.15]");
  put("position = [0.4, 0.2]", "position = [0.4, 0.2, 0.1]");
  return text;
}

TEST(Mesh, CellsAreThoseOutsideOfObstacles) {
  const Mesh flat = made({"cellsPerL=10"}).mesh;
  EXPECT_TRUE(flat.squares);
  EXPECT_EQ(flat.cells(), 40 * 40 - 10 * 10);
  const Mesh deep = made({"cellsPerL=10"}, {}, deep_case()).mesh;
  EXPECT_FALSE(deep.squares);
  EXPECT_EQ(deep.cells(), 40 * 40 * 20 - 10 * 10 * 10);
  EXPECT_EQ(deep.count(2), 3U);
}

TEST(Mesh, AllFacesOfBodiesAreFacesOfCells) {
  const Mesh mesh = made({"cellsPerL=20"}, {"obstacle.0.lower=[0.33, 0.0]"}).mesh;
  EXPECT_FALSE(mesh.squares);
  std::vector<double> faces;
  for (const Piece& piece : mesh.axes[0]) faces.push_back(piece.from);
  EXPECT_THAT(faces, testing::ElementsAre(0.0, 0.1, 0.33));
  EXPECT_EQ(mesh.axes[0][1].cells, 46);
  EXPECT_EQ(mesh.axes[0][2].cells, 14);
}

TEST(Mesh, NumbersThatDoNotDivideAreRefusedWithTheNearestThatDo) {
  // 0.33 - 0.1 = 0.23 and 0.07 are whole in cells of 0.01 m.
  EXPECT_THAT(
      refusal({"cellsPerL=14"}, {"obstacle.0.lower=[0.33, 0.0]"}),
      AllOf(HasSubstr("14 per L = 0.1 m, which make 32.2 cells along x from 0.1 (block.0.upper) "
                      "to 0.33 m (obstacle.0.lower)"),
            HasSubstr("cellsPerL=10 or cellsPerL=20")));
  const NearCells near = near_cells({0.3, 0.5}, 0.2, 5);
  EXPECT_EQ(near.below, 4);
  EXPECT_EQ(near.above, 6);
  EXPECT_FALSE(near_cells({std::sqrt(2.0), 1.0}, 1.0, 10).below);
}

TEST(Mesh, CellsGrowFarAboveTheWaterOnly) {
  const std::vector<std::string> tall{"tank.upper=[0.4, 1.6]"};
  const Mesh mesh = made({"cellsPerL=20"}, tall).mesh;
  const Piece top = mesh.axes[1].back();
  EXPECT_NEAR(top.from, 0.8, 1e-12);
  EXPECT_EQ(top.cells, 20);
  EXPECT_EQ(top.expansion, 26.0);
  // The first of them is as wide as those below, 0.005 m, to the rounding of 26.
  const double ratio = std::pow(26.0, 1.0 / 19.0);
  EXPECT_NEAR(0.8 * (ratio - 1.0) / (std::pow(ratio, 20.0) - 1.0), 0.005, 2e-5);
  EXPECT_EQ(made({"cellsPerL=40"}, tall).mesh.axes[1].back().expansion, 26.0);
  EXPECT_EQ(made({"cellsPerL=20", "coarseAbove=0"}, tall).mesh.axes[1].back().expansion, 1.0);
  EXPECT_EQ(made({"cellsPerL=20"}, {"tank.upper=[0.4, 0.9]"}).mesh.axes[1].back().expansion, 1.0);
  // Where something is up there, they do not.
  const std::vector<std::string> lid{"tank.upper=[0.4, 1.6]", "obstacle.0.lower=[0.3, 1.0]",
                                     "obstacle.0.upper=[0.4, 1.1]"};
  EXPECT_EQ(made({"cellsPerL=20"}, lid).mesh.axes[1].back().expansion, 1.0);
}

// The gate of the wet bed ends where the cells begin to grow: no piece of no cells in between.
TEST(Mesh, CellsGrowFromTheEndOfAGate) {
  const auto with_gate = [](const std::string& upper) {
    const std::string text =
        test::small_case +
        ("[[moving_wall]]\nname = \"gate\"\nlower = [0.1, 0.0]\nupper = [0.12, " + upper +
         "]\ndirection = [0.0, 1.0]\nlaw = \"constant\"\nspeed = 2.0\n" +
         "start = 0.005\nstop = 0.3\n");
    return made({"cellsPerL=20"}, {"tank.upper=[0.4, 1.6]"}, text).mesh.axes[1];
  };
  const Axis ends = with_gate("0.8");
  EXPECT_NEAR(ends.back().from, 0.8, 1e-12);
  EXPECT_EQ(ends.back().expansion, 26.0);
  for (const Piece& piece : ends) EXPECT_GT(piece.cells, 0);
  EXPECT_EQ(with_gate("0.9").back().expansion, 1.0);
}

TEST(Mesh, GrowsTowardsTheSideThatGravityPointsAwayFrom) {
  const Mesh mesh =
      made({"cellsPerL=20"},
           {"tank.lower=[0.0, -1.2]", "tank.open=[\"y-\"]", "fluid.gravity=[0.0, 9.81]",
            "obstacle.0.lower=[0.3, 0.3]", "obstacle.0.upper=[0.4, 0.4]"})
          .mesh;
  EXPECT_FALSE(mesh.up_is_plus);
  EXPECT_NEAR(mesh.axes[1].front().to, -0.4, 1e-12);
  EXPECT_NEAR(mesh.axes[1].front().expansion, 1.0 / 26.0, 1e-12);
}

TEST(Mesh, CellAroundAPlaceIsTwoCellsWhereItLiesBetweenThem) {
  const Mesh mesh = made({"cellsPerL=10"}).mesh;
  EXPECT_NEAR(mesh.cell_around(0, 0.234)[0], 0.23, 1e-12);
  EXPECT_NEAR(mesh.cell_around(0, 0.234)[1], 0.24, 1e-12);
  EXPECT_NEAR(mesh.cell_around(0, 0.2)[0], 0.19, 1e-12);
  EXPECT_NEAR(mesh.cell_around(0, 0.2)[1], 0.21, 1e-12);
  EXPECT_NEAR(mesh.cell_around(0, 0.4)[1], 0.4, 1e-12);
  const Mesh tall = made({"cellsPerL=20"}, {"tank.upper=[0.4, 1.6]"}).mesh;
  EXPECT_NEAR(tall.cell_around(1, 1.6)[1], 1.6, 1e-9);
}

TEST(Mesh, TankThatIsCutInTwoIsRefused) {
  const std::vector<std::string> wall{"obstacle.0.lower=[0.2, 0.0]", "obstacle.0.upper=[0.3, 0.4]"};
  EXPECT_EQ(refusal({}, wall), "made");  // open above both
  std::vector<std::string> closed = wall;
  closed.emplace_back("tank.open=[\"x+\"]");
  closed.emplace_back("probe.0.position=[0.1, 0.2]");
  EXPECT_THAT(refusal({}, closed), HasSubstr("cut into 2 parts, 1 of them closed"));
}

TEST(Mesh, DangerousSizesAreRefusedWithNumbers) {
  EXPECT_THAT(refusal({"cellsPerL=100000"}),
              HasSubstr("found 1.6e+11 cells, expected at most 2e+09"));
  EXPECT_THAT(refusal({"cellsPerL=10000"}),
              AllOf(HasSubstr("a mesh of 1.5e+09 cells, which take about 2.6 TB"),
                    HasSubstr("memory of this machine")));
  const CaseSize size = case_size(made({"cellsPerL=10"}));
  EXPECT_EQ(size.cells, 1500);
  EXPECT_EQ(size.frames, 3);
  EXPECT_GT(size.disk, 3 * 1500 * 8 * 6);
  const nlohmann::json told = to_json(size);
  EXPECT_EQ(told.at("cells"), 1500);
  EXPECT_EQ(told.at("memory_bytes"), size.memory);
  EXPECT_DOUBLE_EQ(told.at("cell"), size.cell);
  EXPECT_EQ(told.size(), 6U);
  CaseSize large = size;
  large.disk = 1e24;
  EXPECT_THROW(check_disk(large, "somewhere/new"), Error);
}

}  // namespace
}  // namespace surge::foam
