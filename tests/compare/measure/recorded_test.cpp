#include "compare/measure/recorded.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compare/measure/measure_all.hpp"
#include "compare/measure/registry.hpp"
#include "tests/compare/measure/frames_in_memory.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::lattice;
using testing::MemoryRun;
using testing::TemporaryFolder;
using testing::write_text;

/// force.dat as OpenFOAM v1912 writes it, one row per time, force -10 t along x and 3 along y.
std::string force_dat(const std::vector<double>& times) {
  std::string text =
      "# Force         \n# CofR          : (0.00000000e+00 0.00000000e+00 0.00000000e+00)\n#\n"
      "# Time          \t(total_x total_y total_z)\t(pressure_x pressure_y pressure_z)\t"
      "(viscous_x viscous_y viscous_z)\n";
  for (const double t : times) {
    text += std::to_string(t) + "     \t(" + std::to_string(-10.0 * t) +
            " 3.0e+00 0)\t(-1 -1 -1)\t(7 7 7)\n";
  }
  return text;
}

std::string probes_p(const std::vector<double>& times, double scale) {
  std::string text =
      "# Probe 0 (0.58 0.0145 0.005)\n# Probe 1 (0.1 0.03 0.005)\n#       Probe             0   1\n"
      "#        Time\n";
  for (const double t : times)
    text += "  " + std::to_string(t) + "  " + std::to_string(scale * t) + "  -2e-1\n";
  return text;
}

MeshFrame still_water(int layers) {
  MeshFrame frame = testing::box_mesh({0.58, 0.29, 0.02}, {58, 29, layers},
                                      [](const Vec3& x) { return x[1] < 0.1 ? 1.0 : 0.0; });
  testing::add_pressure(frame, [](const Vec3& x) { return 9810.0 * std::max(0.1 - x[1], 0.0); });
  return frame;
}

/// A mesh run in a folder, 0.02 m thick.
MemoryRun foam_run(const TemporaryFolder& folder, int dimension) {
  Physics physics = testing::dam_break();
  physics.dimension = dimension;
  physics.tank = Extent{{0, 0, 0}, {0.58, 0.29, 0.02}};
  MemoryRun memory({still_water(dimension == 2 ? 1 : 2)}, physics, 0.01);
  memory.run.path = folder.path();
  return memory;
}

/// Still water of particles, 0.1 m deep, in a tank 0.58 m wide, in 3D 0.05 m.
MemoryRun particle_run(const TemporaryFolder& folder, int dimension) {
  Physics physics = testing::dam_break();
  physics.dimension = dimension;
  const double width = dimension == 3 ? 0.05 : 0.0;
  physics.tank->upper[2] = width;
  ParticleFrame frame = testing::particles(lattice({0, 0, 0}, {0.58, 0.1, width}, 0.01));
  for (const Vec3& x : frame.position) frame.pressure.push_back(9810.0 * (0.1 - x[1]));
  MemoryRun memory({frame}, physics, 0.01);
  memory.run.path = folder.path();
  return memory;
}

Findings measured(MemoryRun& memory, const std::string& request) {
  std::vector<std::unique_ptr<Observable>> one;
  one.push_back(make_observable(request, {memory.run, {}, nullptr}));
  Findings found = measure_all(memory.run, one).front();
  EXPECT_FALSE(found.failure) << found.failure.value_or("");
  return found;
}

TEST(Force, OfAFoamCaseIsPerWidthInTwoDimensions) {
  for (const int dimension : {2, 3}) {
    const TemporaryFolder folder;
    write_text(folder / "postProcessing/onWall/0/force.dat", force_dat({0.1, 0.2}));
    MemoryRun memory = foam_run(folder, dimension);
    const Findings found = measured(memory, "force:name=onWall");
    ASSERT_EQ(found.series.size(), dimension == 2 ? 2U : 3U);
    const double thickness = dimension == 2 ? 0.02 : 1.0;
    EXPECT_EQ(found.series[0].unit, dimension == 2 ? "N/m" : "N");
    EXPECT_EQ(found.series[0].name, "force:name=onWall.x");
    EXPECT_EQ(found.series[0].times, (std::vector{Seconds(0.1), Seconds(0.2)}));
    EXPECT_NEAR(*found.series[0].values[1], -2.0 / thickness, 1e-9);
    EXPECT_NEAR(*found.series[1].values[0], 3.0 / thickness, 1e-9);
  }
}

TEST(Force, OfARestartedCaseContinuesInTheFolderOfItsStart) {
  const TemporaryFolder folder;
  write_text(folder / "postProcessing/onWall/0/force.dat", force_dat({0.1, 0.2, 0.3}));
  // The restart at 0.15 s computes 0.2 s again.
  std::string again = force_dat({0.2, 0.4});
  again.replace(again.find("-2.0"), 4, "-2.5");
  write_text(folder / "postProcessing/onWall/0.15/force.dat", again);
  MemoryRun memory = foam_run(folder, 3);
  const TimeSeries found = measured(memory, "force:name=onWall").series[0];
  EXPECT_EQ(found.times, (std::vector{Seconds(0.1), Seconds(0.2), Seconds(0.4)}));
  EXPECT_NEAR(*found.values[1], -2.5, 1e-9);
}

TEST(Force, OfAParticleRunIsReadFromItsTable) {
  for (const int dimension : {2, 3}) {
    const TemporaryFolder folder;
    // As the program writes it: as many components as the case has dimensions.
    write_text(folder / "steps.csv",
               dimension == 2 ? "time,dt,p1,force_a_x,force_a_y,force_wall_x,force_wall_y\n"
                                "0.001,1e-3,3,1,1,-5,6\n0.002,1e-3,3,1,1,-5.5,6.5\n"
                              : "time,dt,p1,force_wall_x,force_wall_y,force_wall_z\n"
                                "0.001,1e-3,3,-5,6,7\n0.002,1e-3,3,-5.5,6.5,7.5\n");
    MemoryRun memory = particle_run(folder, dimension);
    const Findings found = measured(memory, "force:name=wall");
    ASSERT_EQ(found.series.size(), dimension == 2 ? 2U : 3U);
    EXPECT_EQ(found.series[0].unit, dimension == 2 ? "N/m" : "N");
    EXPECT_EQ(*found.series[0].values[1], -5.5);
    EXPECT_EQ(*found.series[1].values[0], 6.0);
    EXPECT_EQ(found.series[1].times, (std::vector{Seconds(0.001), Seconds(0.002)}));
    if (dimension == 3) {
      EXPECT_EQ(found.series[2].name, "force:name=wall.z");
      EXPECT_EQ(*found.series[2].values[1], 7.5);
    }
    EXPECT_THAT(error_of([&] { (void)measured(memory, "force:name=gate"); }),
                HasSubstr("steps.csv:1: found no column force_gate_x"));
  }
}

TEST(Force, OfBrokenFilesIsAnErrorWithItsPlace) {
  const TemporaryFolder folder;
  MemoryRun memory = foam_run(folder, 2);
  const auto refusal = [&] { return error_of([&] { (void)measured(memory, "force:name=w"); }); };
  EXPECT_THAT(refusal(), HasSubstr("found no force.dat in it"));
  write_text(folder / "postProcessing/w/0/force.dat", force_dat({0.1, 0.1}));
  EXPECT_THAT(refusal(), HasSubstr("force.dat:6: found the time 0.1 s after 0.1 s"));
  write_text(folder / "postProcessing/w/0/force.dat", force_dat({0.1}) + "0.2 (1 2\n");
  EXPECT_THAT(refusal(), HasSubstr("force.dat:6: found 2 numbers, expected 9"));
  write_text(folder / "postProcessing/w/0/force.dat", "# Time other\n0.1 (1 2 3)\n");
  EXPECT_THAT(refusal(), HasSubstr("found no column total_x"));
  write_text(folder / "postProcessing/w/0/force.dat", force_dat({}) + "0.1 (nan 2 3)\n");
  EXPECT_THAT(refusal(), HasSubstr("force.dat:5: found \"nan\""));
}

TEST(Pressure, OfAFoamCaseByNameAndByPlace) {
  const TemporaryFolder folder;
  write_text(folder / "postProcessing/wallPressure/0/p", probes_p({0.1, 0.2}, 100.0));
  MemoryRun memory = foam_run(folder, 2);
  const Findings found = measured(memory, "pressure:x=0.58,y=0.0145");
  EXPECT_EQ(found.series[0].unit, "Pa");
  EXPECT_NEAR(*found.series[0].values[1], 20.0, 1e-9);
  EXPECT_THAT(found.notices, ::testing::Contains(HasSubstr("postProcessing/wallPressure")));
  EXPECT_NEAR(*measured(memory, "pressure:name=wall_pressure,x=0.1,y=0.03").series[0].values[0],
              -0.2, 1e-12);
  EXPECT_THAT(error_of([&] { (void)measured(memory, "pressure:name=wall_pressure"); }),
              HasSubstr("found 2 places"));
  EXPECT_THAT(error_of([&] { (void)measured(memory, "pressure:name=other"); }),
              HasSubstr("no probe \"other\""));
  EXPECT_THAT(error_of([&] { (void)measured(memory, "pressure:x=1"); }), HasSubstr("expected 2"));
}

TEST(Pressure, OfAParticleRunByNameAndByPlace) {
  for (const int dimension : {2, 3}) {
    const TemporaryFolder folder;
    write_text(folder / "steps.csv", "time,dt,p1,p2\n0.001,1,5,6\n0.002,1,7,8\n");
    MemoryRun memory = particle_run(folder, dimension);
    memory.run.manifest["case"]["probes"] = {{{"name", "p1"}, {"position", {0.58, 0.02, 0}}},
                                             {{"name", "p2"}, {"position", {0, 0.02, 0}}}};
    EXPECT_EQ(*measured(memory, "pressure:name=p2").series[0].values[1], 8.0);
    const std::string place = dimension == 2 ? "x=0.58,y=0.02" : "x=0.58,y=0.02,z=0";
    EXPECT_EQ(*measured(memory, "pressure:" + place).series[0].values[0], 5.0);
  }
}

TEST(Pressure, FromFramesOfStillWaterIsHydrostaticOnBothSides) {
  // Two cells or spacings around the place: at the wall and inside the mean of the linear pressure
  // is that at the place itself.
  for (const int dimension : {2, 3}) {
    const TemporaryFolder folder;
    MemoryRun particles = particle_run(folder, dimension);
    MemoryRun mesh = foam_run(folder, dimension);
    for (MemoryRun* memory : {&particles, &mesh}) {
      for (const char* x : {"0.58", "0.3", "0"}) {
        const std::string place = std::string("pressure:x=") + x + ",y=0.04";
        const Findings found = measured(*memory, dimension == 2 ? place : place + ",z=0.01");
        EXPECT_NEAR(*found.series[0].values[0], 9810.0 * 0.06, 1e-6) << x;
        EXPECT_THAT(found.notices, ::testing::Contains(HasSubstr("taken from the pressure")));
      }
      // A place in the air feels nothing.
      const std::string air = "pressure:x=0.3,y=0.2";
      EXPECT_EQ(*measured(*memory, dimension == 2 ? air : air + ",z=0.01").series[0].values[0],
                0.0);
    }
  }
}

TEST(Pressure, WithADiameterIsTheMeanOverMore) {
  const TemporaryFolder folder;
  MemoryRun memory = particle_run(folder, 2);
  // 0.08 m around y = 0.04 m is all of the water below 0.08 m: the mean is that at 0.04 m.
  EXPECT_NEAR(*measured(memory, "pressure:x=0.3,y=0.04,diameter=0.08").series[0].values[0],
              9810.0 * 0.06, 1e-6);
}

TEST(Pressure, IsFilteredByTheMeanOverAnInterval) {
  const TemporaryFolder folder;
  std::string csv = "time,p1\n";
  for (int k = 0; k <= 100; ++k)
    csv += std::to_string(0.001 * k) + "," + std::to_string(k % 2 == 0 ? 10.0 : 20.0) + "\n";
  write_text(folder / "steps.csv", csv);
  MemoryRun memory = particle_run(folder, 2);
  memory.run.manifest["case"]["probes"] = {{{"name", "p1"}, {"position", {0, 0, 0}}}};
  const TimeSeries found = measured(memory, "pressure:name=p1,average=0.01").series[0];
  EXPECT_EQ(found.absent(), 10U);  // half of the interval at either end
  EXPECT_NEAR(*found.values[50], 15.0, 1e-6);
}

}  // namespace
}  // namespace surge::compare
