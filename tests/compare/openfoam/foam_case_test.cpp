#include <gmock/gmock.h>

#include <cstdlib>

#include "../synthetic.hpp"
#include "compare/read/readers.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_text;

namespace fs = std::filesystem;

std::string foam_header(const std::string& type, const std::string& object) {
  return "FoamFile { version 2.0; format ascii; class " + type + "; object " + object + "; }\n";
}

/// A tank of 0.4 m x 0.2 m with 40 x 20 cells and a front that is known at three times: no solver
/// runs, the fields are written by hand.
class FoamCase : public ::testing::Test {
 protected:
  static constexpr double h = 0.01;

  void SetUp() override {
    if (std::system("command -v blockMesh >/dev/null 2>&1") != 0)
      GTEST_SKIP() << "OpenFOAM is not installed";
    write_text(path() / "system/controlDict",
               foam_header("dictionary", "controlDict") +
                   "application interFoam; startFrom startTime; startTime 0; stopAt endTime; "
                   "endTime 0.2; deltaT 0.1; "
                   "writeControl timeStep; writeInterval 1; writeFormat ascii; writePrecision 12; "
                   "timePrecision 6;\n");
    write_text(path() / "system/fvSchemes",
               foam_header("dictionary", "fvSchemes") +
                   "ddtSchemes {} gradSchemes {} divSchemes {} laplacianSchemes {} "
                   "interpolationSchemes {} snGradSchemes {}\n");
    write_text(path() / "system/fvSolution", foam_header("dictionary", "fvSolution"));
    write_text(path() / "system/blockMeshDict",
               foam_header("dictionary", "blockMeshDict") +
                   "convertToMeters 1;\nvertices ((0 0 0) (0.4 0 0) (0.4 0.2 0) (0 0.2 0) (0 0 "
                   "0.01) (0.4 0 0.01) "
                   "(0.4 0.2 0.01) (0 0.2 0.01));\nblocks (hex (0 1 2 3 4 5 6 7) (40 20 1) "
                   "simpleGrading (1 1 1));\n"
                   "edges ();\nboundary (\n walls { type wall; faces ((0 4 7 3) (1 2 6 5) (0 1 5 "
                   "4) (3 7 6 2)); }\n"
                   " sides { type empty; faces ((0 3 2 1) (4 5 6 7)); });\n");
    write_text(path() / "constant/g", foam_header("uniformDimensionedVectorField", "g") +
                                          "dimensions [0 1 -2 0 0 0 0];\nvalue (0 -9.81 0);\n");
    write_text(path() / "constant/transportProperties",
               foam_header("dictionary", "transportProperties") +
                   "phases (water air); water { transportModel Newtonian; nu 1e-06; rho 998.2; } "
                   "air { transportModel Newtonian; nu 1.5e-05; rho 1; } sigma 0;\n");
    for (const char* time : {"0", "0.1", "0.2"}) write_alpha(time);
    shell("blockMesh");
  }

  /// x of the front: 0.1 m at time 0, then between cell faces.
  static double edge(double t) { return 0.1 + 1.013 * t; }

  void write_alpha(const std::string& time) const {
    const double front = edge(std::stod(time));
    std::string values;
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < 40; ++i) {
        const double filled = std::clamp((front - i * h) / h, 0.0, 1.0);
        const bool drop = i >= 35 && i < 38 && j < 3;
        values += std::to_string(drop ? 1.0 : (j < 10 ? filled : 0.0)) + "\n";
      }
    }
    write_text(path() / time / "alpha.water",
               foam_header("volScalarField", "alpha.water") +
                   "dimensions [0 0 0 0 0 0 0];\ninternalField nonuniform List<scalar> 800\n(\n" +
                   values +
                   ");\nboundaryField { walls { type zeroGradient; } sides { type empty; } }\n");
  }

  [[nodiscard]] fs::path path() const { return folder_ / "case"; }

  void shell(const std::string& command) const {
    const std::string line = "cd '" + path().string() + "' && WM_PROJECT_DIR=/usr/share/openfoam " +
                             command + " > log 2>&1 || { cat log; exit 1; }";
    ASSERT_EQ(std::system(line.c_str()), 0) << command;
  }

  void set_control(const std::string& key, const std::string& value) const {
    shell("foamDictionary -entry " + key + " -set " + value + " system/controlDict");
  }

  void expect_known_front(const SourceOptions& options = {}) const {
    auto run = open_run(path(), options);
    ASSERT_EQ(run.frames->times().size(), 3U);
    EXPECT_EQ(run.frames->times()[0], Seconds(0.0));
    FrontOptions front;
    for (const FrontSample& sample : measure_front(run, front)) {
      EXPECT_NEAR(sample.position.value(), edge(sample.time.value()), 1e-6) << sample.time.value();
    }
  }

  /// The drop stands ahead of the column at time 0 already, so the width must be said.
  static SourceOptions width() {
    SourceOptions options;
    options.column_width = Metres(0.1);
    return options;
  }

  TemporaryFolder folder_;
};

TEST_F(FoamCase, AsciiIsReadWithItsPhysics) {
  expect_known_front(width());
  const auto run = open_run(path(), width());
  EXPECT_EQ(run.method, "vof");
  EXPECT_EQ(run.physics.dimension, 2);
  EXPECT_DOUBLE_EQ(run.physics.density.value(), 998.2);
  EXPECT_DOUBLE_EQ(run.physics.kinematic_viscosity.value(), 1e-6);
  EXPECT_DOUBLE_EQ(run.physics.gravity[1], -9.81);
  EXPECT_NEAR(run.physics.far_wall().value().value(), 0.4, 1e-6);
  EXPECT_NEAR(run.cells_per_width.value(), 10.0, 1e-4);
}

TEST_F(FoamCase, CompressedIsRead) {
  set_control("writeCompression", "on");
  shell("foamFormatConvert");
  ASSERT_TRUE(fs::exists(path() / "0.1/alpha.water.gz"));
  expect_known_front(width());
}

TEST_F(FoamCase, BinaryIsRead) {
  set_control("writeFormat", "binary");
  shell("foamFormatConvert");
  expect_known_front(width());
}

TEST_F(FoamCase, DecomposedIsRead) {
  write_text(path() / "system/decomposeParDict", foam_header("dictionary", "decomposeParDict") +
                                                     "numberOfSubdomains 4; method simple; "
                                                     "simpleCoeffs { n (2 2 1); delta 0.001; }\n");
  shell("decomposePar -time 0:0.2");
  for (const char* time : {"0", "0.1", "0.2"}) fs::remove_all(path() / time);
  ASSERT_TRUE(fs::exists(path() / "processor3/0.1/alpha.water"));
  expect_known_front(width());
}

TEST_F(FoamCase, CollatedIsRead) {
  for (const char* format : {"ascii", "binary"}) {
    set_control("writeFormat", format);
    write_text(path() / "system/decomposeParDict",
               foam_header("dictionary", "decomposeParDict") +
                   "numberOfSubdomains 4; method simple; "
                   "simpleCoeffs { n (2 2 1); delta 0.001; }\n");
    shell("decomposePar -force -time 0:0.2 -fileHandler collated");
    fs::create_directories(path() / "serial");
    for (const char* time : {"0", "0.1", "0.2"})
      fs::rename(path() / time, path() / "serial" / time);
    ASSERT_TRUE(fs::exists(path() / "processors4/0.1/alpha.water"));
    expect_known_front(width());
    for (const char* time : {"0", "0.1", "0.2"})
      fs::rename(path() / "serial" / time, path() / time);
  }
}

TEST_F(FoamCase, MeshRefinedByOpenFoamIsRead) {
  // The upper half of the column: the front runs below it.
  write_text(path() / "system/topoSetDict",
             foam_header("dictionary", "topoSetDict") +
                 "actions ( { name fine; type cellSet; action new; source boxToCell; box (0 0.06 "
                 "-1) (0.2 0.1 1); } );\n");
  shell("topoSet");
  write_text(path() / "system/refineMeshDict",
             foam_header("dictionary", "refineMeshDict") +
                 "set fine; coordinateSystem global; globalCoeffs { tan1 (1 0 0); tan2 (0 1 0); } "
                 "directions (tan1 tan2); useHexTopology no; geometricCut yes; writeMesh no;\n");
  for (const char* time : {"0.1", "0.2"}) fs::remove_all(path() / time);
  shell("refineMesh -overwrite");
  write_text(path() / "0/alpha.water",
             foam_header("volScalarField", "alpha.water") +
                 "dimensions [0 0 0 0 0 0 0];\ninternalField uniform 0.5;\nboundaryField { walls { "
                 "type zeroGradient; } sides { type empty; } }\n");
  const auto run = open_run(path(), width());
  const auto frame = std::get<MeshFrame>(run.frames->read(0, {}));
  EXPECT_EQ(frame.alpha.size(), 800U + 3U * 20U * 4U);
  EXPECT_EQ(run.physics.dimension, 2);
  EXPECT_NEAR(run.physics.tank->upper[1], 0.2, 1e-12);
}

TEST_F(FoamCase, BadCasesAreNamed) {
  SourceOptions options = width();
  options.alpha_array = "alpha.wine";
  EXPECT_THAT(error_of([&] { (void)open_run(path(), options); }), HasSubstr("wine"));
  write_text(path() / "0.1/alpha.water", "nonsense;");
  EXPECT_THAT(error_of([&] {
                auto run = open_run(path(), width());
                (void)measure_front(run, {});
              }),
              HasSubstr("0.1/alpha.water"));
  fs::remove(path() / "0.1/alpha.water");
  // A time without the field is left out, and told.
  {
    auto run = open_run(path(), width());
    (void)measure_front(run, {});
    EXPECT_EQ(run.frames->times().size(), 2U);
    EXPECT_THAT(run.notices,
                ::testing::Contains(HasSubstr("time 0.1 has no alpha.water: left out")));
  }
  fs::remove(path() / "constant/g");
  EXPECT_THAT(error_of([&] { (void)open_run(path(), width()); }),
              HasSubstr("constant/g: cannot be opened"));
  fs::remove_all(path() / "constant/polyMesh");
  EXPECT_THAT(error_of([&] { (void)open_run(path(), width()); }),
              HasSubstr("no constant/polyMesh"));
}

}  // namespace
}  // namespace surge::compare
