// The dictionaries of made cases, parsed back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "compare/read/foam_dictionary.hpp"
#include "foam_cases/gates.hpp"
#include "tests/foam/foam_fixture.hpp"
#include "tests/places.hpp"

namespace surge::foam {
namespace {

namespace fs = std::filesystem;
using compare::FoamDictionary;
using test::made;
using test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;

/// A made case on the disk, where #include finds what it names.
class Dictionaries : public testing::Test {
 protected:
  void write(const FoamCase& c) {
    fs::remove_all(folder_);
    write_case(case_files(c), folder_, false);
  }
  [[nodiscard]] FoamDictionary read(const std::string& path) const {
    return FoamDictionary::read(folder_ / path, folder_);
  }

  tests::TemporaryFolder files_;
  const fs::path folder_ = files_.path() / "case";
};

TEST_F(Dictionaries, HoldTheCaseAndTheSettings) {
  write(made({"cellsPerL=10", "maxCo=0.25", "rhoAir=1.2"},
             {"fluid.kinematic_viscosity=1e-6", "tank.wall=no-slip"}));
  const FoamDictionary control = read("system/controlDict");
  EXPECT_EQ(control.number("endTime"), 0.02);
  EXPECT_EQ(control.number("writeInterval"), 0.01);
  EXPECT_EQ(control.number("maxCo"), 0.25);
  EXPECT_EQ(control.words("application"), std::vector<std::string>{"interFoam"});
  const FoamDictionary fluids = read("constant/transportProperties");
  EXPECT_EQ(fluids.dictionary("water").number("nu"), 1e-6);
  EXPECT_EQ(fluids.dictionary("water").number("rho"), 1000.0);
  EXPECT_EQ(fluids.dictionary("air").number("rho"), 1.2);
  EXPECT_THAT(read("constant/g").numbers("value", 3), ElementsAre(0.0, -9.81, 0.0));
  const FoamDictionary walls = read("0.orig/U")
                                   .dictionary("boundaryField")
                                   .dictionary("(leftWall|rightWall|floor|obstacle0)");
  EXPECT_EQ(walls.words("type"), std::vector<std::string>{"noSlip"});
  EXPECT_EQ(fs::exists(folder_ / "constant/fvOptions"), false);
}

TEST_F(Dictionaries, ProbesGaugesAndForcesAreFunctionObjects) {
  std::string text = test::small_case;
  text +=
      "[[probe]]\nname = \"step top\"\nposition = [0.35, 0.1]\n"
      "[[gauge]]\nname = \"a\"\nposition = [0.2, 0.0]\n[[force]]\non = \"obstacle.0\"\n";
  write(made({"cellsPerL=10"}, {}, text));
  const FoamDictionary functions = read("system/controlDict").dictionary("functions");
  // Inside of the mesh by a millionth of L.
  EXPECT_THAT(functions.dictionary("wallPressure").numbers("probeLocations", 3),
              ElementsAre(0.4 - 1e-7, 0.2, 0.05));
  EXPECT_THAT(functions.dictionary("stepTop").numbers("probeLocations", 3),
              ElementsAre(0.35, testing::DoubleNear(0.1 + 1e-7, 1e-12), 0.05));
  EXPECT_NEAR(functions.dictionary("a").number("area"), 0.02 * 0.1, 1e-12);
  EXPECT_EQ(functions.dictionary("obstacle0Force").words("patches"),
            std::vector<std::string>{"obstacle0"});
  const std::string zones = case_files(made({"cellsPerL=10"}, {}, text)).at("system/topoSetDict");
  EXPECT_THAT(zones, HasSubstr("cellZoneSet"));
}

TEST_F(Dictionaries, TwoRecordsInOnePlaceAreRefused) {
  std::string text = test::small_case;
  text += "[[probe]]\nname = \"wall pressure\"\nposition = [0.0, 0.1]\n";
  EXPECT_THAT(refusal({}, {}, text), HasSubstr("both recorded as postProcessing/wallPressure"));
}

TEST_F(Dictionaries, ReferencesOfThePressureAreWhereTheyMustBe) {
  // Closed: zero at the highest cell. The floor is not at zero: gh begins there.
  write(made({"cellsPerL=10"}, {"tank.open=[]", "tank.lower=[0.0, -0.1]"}));
  const FoamDictionary pimple = read("system/fvSolution").dictionary("PIMPLE");
  EXPECT_NEAR(pimple.numbers("pRefPoint", 3)[1], 0.395, 1e-9);
  EXPECT_EQ(read("constant/hRef").number("value"), -0.1);
  write(made({"cellsPerL=10"}));
  EXPECT_FALSE(read("system/fvSolution").dictionary("PIMPLE").has("pRefPoint"));
  EXPECT_FALSE(fs::exists(folder_ / "constant/hRef"));
}

TEST_F(Dictionaries, MeshStatesItsObstaclesAndItsCells) {
  write(made({"cellsPerL=20"}, {"obstacle.0.lower=[0.33, 0.0]"}));
  const FoamDictionary mesh = read("system/blockMeshDict");
  EXPECT_THAT(mesh.numbers("obstacles", 6), ElementsAre(0.33, 0.0, 0.0, 0.4, 0.1, 0.1));
  EXPECT_EQ(mesh.number("nx1"), 46.0);
  EXPECT_EQ(mesh.number("cellSize"), 0.005);
  EXPECT_FALSE(
      read("system/caseParameters").has("cellsPerL"));  // to change it would change nothing
}

TEST_F(Dictionaries, RowsOfAGateOpenAsItsLowerEdgePassesThem) {
  std::string text = test::small_case;
  text +=
      "[[moving_wall]]\nname = \"my gate\"\nlower = [0.1, 0.0]\nupper = [0.12, 0.3]\n"
      "direction = [0.0, 1.0]\nlaw = \"constant\"\nspeed = 2.0\nstart = 0.005\nstop = 0.3\n";
  const FoamCase c = made({"cellsPerL=10"}, {}, text);
  const std::vector<GateRow> rows = gate_rows(c, c.flow.moving_walls[0]);
  ASSERT_EQ(rows.size(), 33U);  // 30 of its own, and 3 that it reaches until the end
  EXPECT_NEAR(rows[0].until, 0.005 + 0.005 / 2.0, 2e-6);
  EXPECT_NEAR(rows[2].until, 0.005 + 0.025 / 2.0, 2e-6);
  EXPECT_GT(rows[29].until, 0.02);
  EXPECT_EQ(rows[29].from, 0.0);
  EXPECT_NEAR(rows[30].from, 0.005 + 0.005 / 2.0, 2e-6);
  EXPECT_NEAR(rows[3].box.lower[1], 0.03, 1e-12);
  EXPECT_EQ(rows[3].box.lower[0], 0.1);
  write(c);
  const FoamDictionary options = read("constant/fvOptions");
  const auto& row = options.dictionary("myGateRow2").dictionary("explicitPorositySourceCoeffs");
  EXPECT_NEAR(row.number("duration"), 0.0175, 2e-6);
  EXPECT_EQ(row.number("rhoRef"), 1000.0);
  EXPECT_EQ(read("constant/movingWalls").dictionary("wall0").number("speed"), 2.0);
}

TEST_F(Dictionaries, APistonIsASideOfTheMesh) {
  // Behind the water's left side; the tank of the mesh begins at its face.
  const std::string text =
      std::string(test::small_case) +
      "[[moving_wall]]\nname = \"paddle\"\nlower = [-0.08, 0.0]\nupper = [0.0, 0.25]\n"
      "direction = [1.0, 0.0]\nlaw = \"harmonic\"\namplitude = 0.05\nperiod = 0.5\n";
  const std::vector<std::string> longer{"tank.lower=[-0.1, 0.0]"};
  const FoamCase c = made({"cellsPerL=10"}, longer, text);
  EXPECT_EQ(c.mesh.lower(0), 0.0);
  EXPECT_EQ(c.mesh.cells(), 1500);
  ASSERT_EQ(c.pistons.size(), 1U);
  EXPECT_EQ(c.pistons[0].tank_end, -0.1);
  write(c);
  const FoamDictionary points = read("0.orig/pointDisplacement").dictionary("boundaryField");
  EXPECT_EQ(points.dictionary("leftWall").words("type"),
            std::vector<std::string>{"uniformFixedValue"});
  EXPECT_EQ(points.dictionary("floor").words("type"), std::vector<std::string>{"slip"});
  EXPECT_EQ(points.dictionary("rightWall").words("type"), std::vector<std::string>{"fixedValue"});
  const FoamDictionary velocity = read("0.orig/U").dictionary("boundaryField");
  EXPECT_EQ(velocity.dictionary("leftWall").words("type"),
            std::vector<std::string>{"movingWallVelocity"});
  EXPECT_EQ(read("constant/movingWalls").dictionary("wall0").number("tankEnd"), -0.1);
  // It must begin at displacement zero and stay clear of what is before it.
  std::vector<std::string> changed = longer;
  changed.emplace_back("moving_wall.0.phase=1.0");
  EXPECT_THAT(refusal({"cellsPerL=10"}, changed, text), HasSubstr("m out at time 0"));
  changed.back() = "moving_wall.0.amplitude=5.0";
  EXPECT_THAT(refusal({"cellsPerL=10"}, changed, text),
              HasSubstr("expected at most 0.9 of the 0.3 m"));
}

TEST_F(Dictionaries, WhatVofDoesNotComputeIsRefusedInOneLine) {
  EXPECT_THAT(refusal({}, {"tank.periodic=[\"y\"]", "tank.open=[]"}),
              HasSubstr("fluid.gravity: found -9.81 m/s2 along a periodic axis"));
  const auto wall = [](const std::string& lines) {
    return std::string(test::small_case) + "[[moving_wall]]\nname = \"gate\"\n" + lines;
  };
  const std::string plate = "lower = [0.1, 0.0]\nupper = [0.12, 0.3]\n";
  const std::string steady = "law = \"constant\"\nspeed = 1.0\nstop = 0.3\n";
  EXPECT_THAT(
      refusal({}, {},
              wall("lower = [0.1, 0.0]\nupper = [0.12, 0.1]\n"
                   "direction = [1.0, 0.0]\n" +
                   steady)),
      HasSubstr("moving_wall.0.direction: found a wall 0.02 m long in its direction and 0.1 m "
                "thick, which pushes water, expected a gate"));
  EXPECT_THAT(refusal({}, {}, wall(plate + "direction = [1.0, 0.0]\n" + steady)),
              HasSubstr("found the piston \"gate\" between water, obstacles or instruments"));
  const std::string up = plate + "direction = [0.0, 1.0]\n";
  EXPECT_THAT(refusal({}, {}, wall(up + "law = \"harmonic\"\namplitude = 0.2\nperiod = 0.01\n")),
              HasSubstr("expected a gate that passes each place once"));
  EXPECT_EQ(refusal({}, {}, wall(up + steady)), "made");
  EXPECT_THAT(refusal({}, {}, wall(up + steady + "[[force]]\non = \"gate\"\n")),
              HasSubstr("force.0.on: found a gate"));
  std::string text = test::small_case;
  const auto begin = text.find("[tank]");
  text.erase(begin, text.find("[[block]]") - begin);
  EXPECT_THAT(refusal({}, {}, text), HasSubstr("found no tank"));
}

TEST_F(Dictionaries, AFolderThatHoldsSomethingIsNotWrittenInto) {
  write(made());
  EXPECT_THROW(write_case(case_files(made()), folder_, false), Error);
  EXPECT_NO_THROW(write_case(case_files(made()), folder_, true));
  fs::remove_all(folder_);
  fs::create_directories(folder_ / "mine");
  EXPECT_THROW(write_case(case_files(made()), folder_, true), Error);
}

/// The files of a folder that belong to the case.
std::string file_text(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(DamBreak, InTheRepositoryIsWhatIsMade) {
  const fs::path root = tests::sources(), folder = root / "foam_cases/damBreak2D";
  const Files files = case_files(read_foam_case(root / "particle/cases/dam_break.toml", {}, {}));
  for (const auto& [path, text] : files) {
    EXPECT_EQ(text, file_text(folder / path))
        << path << ": make it anew with\n  surge-foam make particle/cases/dam_break.toml --out "
        << "foam_cases/damBreak2D --force";
  }
  for (const char* part : {"system", "constant", "0.orig"}) {
    for (const auto& file : fs::directory_iterator(folder / part)) {
      if (!file.is_regular_file()) continue;
      EXPECT_TRUE(files.contains(fs::relative(file, folder))) << file.path() << " is not made";
    }
  }
}

}  // namespace
}  // namespace surge::foam
