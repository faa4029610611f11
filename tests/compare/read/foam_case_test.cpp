#include "compare/read/foam_case.hpp"

#include <gmock/gmock.h>

#include "tests/compare/foam_dam.hpp"

namespace surge::compare {
namespace {

using testing::bytes_of;
using ::testing::Contains;
using ::testing::ElementsAre;
using testing::error_of;
using testing::expect_foam_front;
using testing::foam_tank;
using testing::foam_water;
using testing::FoamCaseWriter;
using testing::FoamLayout;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;
using testing::write_text;

namespace fs = std::filesystem;

class FoamCaseFiles : public ::testing::Test {
 protected:
  void write(const FoamLayout& layout = {}, int layers = 1) const {
    FoamCaseWriter(path(), foam_tank(layers), layout).write(foam_water);
  }
  [[nodiscard]] fs::path path() const { return folder_ / "case"; }
  [[nodiscard]] std::vector<std::string> notices(const SourceOptions& options = {}) const {
    auto run = open_run(path(), options);
    (void)measure_front(run, {});
    return run.notices;
  }
  [[nodiscard]] std::string refusal(const SourceOptions& options = {}) const {
    return error_of([&] { (void)open_run(path(), options); });
  }

  TemporaryFolder folder_;
};

TEST_F(FoamCaseFiles, PhysicsIsThatOfTheFiles) {
  write();
  const auto run = open_run(path());
  EXPECT_EQ(run.method, "vof");
  EXPECT_EQ(run.physics.dimension, 2);
  EXPECT_EQ(run.physics.density, 998.2);
  EXPECT_EQ(run.physics.kinematic_viscosity, 1e-6);
  EXPECT_EQ(run.physics.gravity, (Vec3{0.0, -9.81, 0.0}));
  EXPECT_NEAR(run.spacing.value(), 0.01, 1e-15);
  EXPECT_NEAR(run.cells_per_width.value(), 10.0, 1e-9);
  EXPECT_EQ(run.physics.tank->upper, (Vec3{0.4, 0.2, 0.01}));
}

TEST_F(FoamCaseFiles, FoamFileNamesItsCase) {
  write();
  write_text(path() / "dam.foam", "");
  expect_foam_front(path() / "dam.foam", 3);
  EXPECT_EQ(open_run(path() / "dam.foam").name, "case");
}

TEST_F(FoamCaseFiles, OnlyVolumeFractionIsFoundByItself) {
  FoamLayout layout;
  layout.alpha = "alpha.oil";
  write(layout);
  expect_foam_front(path(), 3);
  EXPECT_THAT(notices(), Contains(HasSubstr("alpha.oil is taken as the volume fraction")));
  SourceOptions options;
  options.alpha_array = "alpha.wine";
  EXPECT_THAT(refusal(options), HasSubstr("no alpha.wine, found alpha.oil"));
  fs::copy_file(path() / "0/alpha.oil", path() / "0/alpha.gas");
  EXPECT_THAT(refusal(), HasSubstr("no alpha.water, found alpha.gas, alpha.oil"));
  options.alpha_array = "alpha.oil";
  expect_foam_front(path(), 3, options);
}

TEST_F(FoamCaseFiles, PropertiesOfTheFoundationsVersions) {
  write();
  fs::remove(path() / "constant/transportProperties");
  EXPECT_THAT(notices(), Contains(HasSubstr("no density and viscosity of water")));
  write_text(path() / "constant/phaseProperties", "phases (water air); sigma 0.07;");
  write_text(path() / "constant/physicalProperties.water",
             "viscosityModel constant; nu [0 2 -1 0 0 0 0] 2e-06; rho 997;");
  const auto run = open_run(path());
  EXPECT_EQ(run.physics.density, 997.0);
  EXPECT_EQ(run.physics.kinematic_viscosity, 2e-6);
  EXPECT_THAT(notices(), IsEmpty());
}

TEST_F(FoamCaseFiles, PropertiesThatNoWaterHasAreRefused) {
  write();
  const fs::path transport = path() / "constant/transportProperties";
  write_text(transport, "phases (water air); water { nu 1e-06; rho -5; } air { rho 1; }");
  EXPECT_THAT(refusal(), HasSubstr("water: rho: -5 found, more than 0 expected"));
  write_text(transport, "phases (water air); water { nu -1; rho 998; } air { rho 1; }");
  EXPECT_THAT(refusal(), HasSubstr("water: nu: -1 found, at least 0 expected"));
  write_text(transport, "phases (water air); water { nu 1e-06; rho 1; } air { rho 998; }");
  EXPECT_THAT(refusal(), HasSubstr("air: rho: 998 of air found and 1 of water, whose field "
                                   "alpha.water is read as the water's; the heavier phase"));
  fs::remove(transport);
  write_text(path() / "constant/phaseProperties", "phases (water air); sigma 0.07;");
  write_text(path() / "constant/physicalProperties.water", "nu 2e-06; rho 1.2;");
  write_text(path() / "constant/physicalProperties.air", "nu 2e-06; rho 1000;");
  EXPECT_THAT(refusal(), HasSubstr("physicalProperties.air: rho: 1000 of air found"));
}

TEST_F(FoamCaseFiles, ValuesFromIncludedFilesAndMacros) {
  write();
  write_text(path() / "system/parameters", "g0 9.81; rhoWater 1000; fluid { nu 3e-06; }");
  write_text(path() / "constant/g",
             "#include \"$FOAM_CASE/system/parameters\"\ndown -9.81;\nvalue (0 $down 0);");
  write_text(path() / "constant/transportProperties",
             "#includeEtc \"caseDicts/general\"\n#include \"<system>/parameters\"\n"
             "water { $fluid; rho ${rhoWater}; }");
  const auto run = open_run(path());
  EXPECT_EQ(run.physics.gravity, (Vec3{0.0, -9.81, 0.0}));
  EXPECT_EQ(run.physics.density, 1000.0);
  EXPECT_EQ(run.physics.kinematic_viscosity, 3e-6);
  // A uniform field may come from a macro, too.
  write_text(path() / "0.1/alpha.water",
             "none 0;\ninternalField uniform $none;\nboundaryField { #includeEtc \"x\" }\n");
  EXPECT_EQ(std::get<MeshFrame>(open_run(path()).frames->read(1, {})).alpha,
            std::vector<double>(800, 0.0));
}

TEST_F(FoamCaseFiles, StartThatIsNotZeroIsTheStart) {
  FoamLayout layout;
  layout.times = {"5", "5.1", "5.2"};
  FoamCaseWriter(path(), foam_tank(), layout).write([](Vec3 low, Vec3 high, double time) {
    return foam_water(low, high, time - 5.0);
  });
  expect_foam_front(path(), 3);
  EXPECT_THAT(notices(), Contains(HasSubstr("count from the start of the case, 5 s")));
  // A solver has written it: the beginning is not there.
  write_text(path() / "5/uniform/time", "value 5; name \"5\"; index 120; deltaT 0.001;");
  EXPECT_THAT(refusal(), HasSubstr("the first time is 5 s"));
}

TEST_F(FoamCaseFiles, WaterThatMovesAlreadyIsNoStart) {
  FoamLayout layout;
  layout.times = {"5", "5.1"};
  FoamCaseWriter(path(), foam_tank(), layout).write([](Vec3 low, Vec3 high, double time) {
    return foam_water(low, high, time - 5.0);
  });
  write_text(path() / "5/U", "internalField uniform (0.1 0 0);\nboundaryField {}\n");
  EXPECT_THAT(refusal(), HasSubstr("the first time is 5 s"));
}

TEST_F(FoamCaseFiles, RegionWithTheWaterIsRead) {
  FoamLayout layout;
  layout.region = "fluid";
  write(layout);
  expect_foam_front(path(), 3);
  EXPECT_THAT(notices(), Contains(HasSubstr("region fluid is read")));
  // A second one without water does not matter, one with water does.
  fs::copy(path() / "constant/fluid", path() / "constant/solid", fs::copy_options::recursive);
  expect_foam_front(path(), 3);
  fs::create_directories(path() / "0/solid");
  fs::copy_file(path() / "0/fluid/alpha.water", path() / "0/solid/alpha.water");
  EXPECT_THAT(refusal(), HasSubstr("regions fluid, solid found, 2 with a volume fraction"));
}

TEST_F(FoamCaseFiles, TimesThatAreMissingAreTold) {
  FoamLayout layout;
  layout.times = {"0", "0.1", "0.2", "0.29"};
  write(layout);
  EXPECT_THAT(notices(), IsEmpty());
  fs::remove_all(path() / "0.2");
  EXPECT_THAT(notices(), ElementsAre(HasSubstr("1 gap in the times, which are else 0.1 s apart: "
                                               "0.1 to 0.29")));
  fs::remove_all(path() / "0.29");
  EXPECT_THAT(notices(),
              ElementsAre(HasSubstr("the last time is 0.1 s, endTime of the case 0.29")));
}

TEST_F(FoamCaseFiles, ResultsInTwoPlacesAreTold) {
  write();
  FoamLayout layout;
  layout.processors = 2;
  layout.times = {"0", "0.1"};
  write(layout);
  expect_foam_front(path(), 3);
  EXPECT_THAT(notices(), ElementsAre(HasSubstr(
                             "results found in the case itself (3 times) and in processor folders "
                             "(2 times): the former are read")));
}

TEST_F(FoamCaseFiles, UnfinishedLastTimeIsLeftOutAndTold) {
  for (const bool packed : {false, true}) {
    FoamLayout layout;
    layout.packed = packed;
    write(layout);
    const fs::path last = path() / (packed ? "0.2/alpha.water.gz" : "0.2/alpha.water");
    for (const double part : {0.0, 0.3, 0.6, 0.99}) {
      const std::string whole = bytes_of(last);
      write_text(last, whole.substr(
                           0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
      expect_foam_front(path(), 2);
      EXPECT_THAT(notices(), Contains(HasSubstr("time 0.2 is unfinished"))) << part;
      write_text(last, whole);
    }
    const fs::path middle = path() / (packed ? "0.1/alpha.water.gz" : "0.1/alpha.water");
    const std::string whole = bytes_of(middle);
    write_text(middle, whole.substr(0, whole.size() / 2));
    EXPECT_THAT(error_of([&] { (void)notices(); }), HasSubstr("0.1/alpha.water"));
    fs::remove_all(path());
  }
}

TEST_F(FoamCaseFiles, WaterThatIsNoColumnIsRefused) {
  const auto written = [&](const auto& part) {
    FoamCaseWriter(path(), foam_tank(), {}).write([&](Vec3 low, Vec3 high, double) {
      return part(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])) ? 1.0 : 0.0;
    });
  };
  written([](double, double) { return false; });
  EXPECT_THAT(refusal(), HasSubstr("no water at time 0"));
  written([](double, double y) { return y < 0.05; });
  EXPECT_THAT(refusal(), HasSubstr("the water reaches the far wall, x = 0.4 m"));
  written([](double x, double) { return x > 0.1 && x < 0.2; });
  EXPECT_THAT(refusal(), HasSubstr("water from x = 0.1 m on at time 0, none at the wall"));
  written([](double x, double) { return x < 0.1 || (x > 0.2 && x < 0.3); });
  EXPECT_THAT(refusal(), HasSubstr("water from x = 0.2 m on at time 0, apart from"));
  written([](double x, double y) { return x < 0.1 || (x < 0.3 && y < 0.05); });
  EXPECT_THAT(refusal(), HasSubstr("a column with upright sides"));
  SourceOptions options;
  options.column_width = Metres(0.1);
  EXPECT_DOUBLE_EQ(open_run(path(), options).physics.column_width().value(), 0.1);
}

TEST_F(FoamCaseFiles, ChangesOfTheWatersVolumeAreTold) {
  FoamCaseWriter(path(), foam_tank(), {}).write([](Vec3 low, Vec3 high, double time) {
    return foam_water(low, high, time) * (time > 0.15 ? 0.99 : 1.0);
  });
  EXPECT_THAT(notices(),
              ElementsAre(HasSubstr("changes by up to -1 % from the first time (at 0.2")));
}

/// The manifest of the case that foam_water fills.
nlohmann::json manifest() {
  return nlohmann::json::parse(R"({"case": {"dimension": 2, "cells_per_L": 10,
    "method": {"name": "vof", "preset": "slip"}, "time": {"end": 0.2}, "output": {"interval": 0.1},
    "fluid": {"density": 998.2, "kinematic_viscosity": 1e-6, "gravity": [0, -9.81, 0]},
    "tank": {"lower": [0, 0, 0], "upper": [0.4, 0.2, 0], "wall": "slip"},
    "blocks": [{"shape": "box", "lower": [0, 0, 0], "upper": [0.1, 0.1, 0]}]}})");
}

TEST_F(FoamCaseFiles, WaterAtTheStartIsThatOfTheManifest) {
  write();
  nlohmann::json stated = manifest();
  write_text(path() / "manifest.json", stated.dump());
  EXPECT_THAT(notices(), IsEmpty());
  stated["case"]["blocks"][0]["upper"] = {0.1, 0.08, 0};
  write_text(path() / "manifest.json", stated.dump());
  EXPECT_THAT(refusal(), HasSubstr("0.0001 m3 in the mesh, 8e-05 m3 in the 1 blocks"));
  // As much water, but elsewhere.
  stated["case"]["blocks"][0]["lower"] = {0.1, 0, 0};
  stated["case"]["blocks"][0]["upper"] = {0.2, 0.1, 0};
  write_text(path() / "manifest.json", stated.dump());
  EXPECT_THAT(refusal(), HasSubstr("200 % of it elsewhere"));
}

TEST_F(FoamCaseFiles, SecondBlockOfWaterThatTheManifestLacksIsRefused) {
  FoamCaseWriter(path(), foam_tank(), {}).write([](Vec3 low, Vec3 high, double) {
    return high[1] < 0.031 || (high[0] < 0.101 && high[1] < 0.101) ? 1.0 : 0.0 * low[0];
  });
  write_text(path() / "manifest.json", manifest().dump());
  EXPECT_THAT(refusal(), HasSubstr("made by another setFieldsDict?"));
  nlohmann::json both = manifest();
  both["case"]["blocks"].push_back(
      {{"shape", "box"}, {"lower", {0, 0, 0}}, {"upper", {0.4, 0.03, 0}}});
  write_text(path() / "manifest.json", both.dump());
  EXPECT_EQ(testing::refusal_of([&] { (void)open_run(path()); }), "");
}

TEST_F(FoamCaseFiles, TimesThatTheManifestAnnouncesAreMissed) {
  write();
  nlohmann::json stated = manifest();
  stated["case"]["output"]["interval"] = 0.05;
  write_text(path() / "manifest.json", stated.dump());
  EXPECT_THAT(notices(), ElementsAre(HasSubstr("2 of the times that manifest.json announces")));
}

TEST(FoamManifest, BallsOfWaterIn3D) {
  const TemporaryFolder folder;
  nlohmann::json stated = manifest();
  stated["case"]["dimension"] = 3;
  stated["case"]["blocks"][0] = {
      {"shape", "ball"}, {"lower", {0.1, 0.05, 0.0}}, {"upper", {0.2, 0.15, 0.1}}};
  const auto ball = [](Vec3 low, Vec3 high, double) {
    const Vec3 x{0.5 * (low[0] + high[0]) - 0.15, 0.5 * (low[1] + high[1]) - 0.1,
                 0.5 * (low[2] + high[2]) - 0.05};
    return std::hypot(x[0], x[1], x[2]) < 0.05 ? 1.0 : 0.0;
  };
  FoamCaseWriter(folder / "case", foam_tank(10), {}).write(ball);
  write_text(folder / "case/manifest.json", stated.dump());
  EXPECT_EQ(testing::refusal_of([&] { (void)open_run(folder / "case"); }), "");
  stated["case"]["blocks"][0]["lower"] = {0.15, 0.05, 0.0};
  stated["case"]["blocks"][0]["upper"] = {0.25, 0.15, 0.1};
  write_text(folder / "case/manifest.json", stated.dump());
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "case"); }), HasSubstr("elsewhere"));
}

}  // namespace
}  // namespace surge::compare
