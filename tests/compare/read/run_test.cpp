#include "compare/read/run.hpp"

#include <gmock/gmock.h>
#include <vtkDataSetWriter.h>

#include "compare/read/readers.hpp"
#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::error_of;
using ::testing::HasSubstr;
using testing::lattice;
using testing::TemporaryFolder;
using testing::write_run;
using testing::write_text;
using testing::write_vtp;

double surge(double t) {
  return 0.145 + 2.0 * t;
}

TEST(ParticleRun, IsReadWithItsCaseAndFields) {
  const TemporaryFolder folder;
  write_run(folder / "mps-paper-0.005", {0.0, 0.05, 0.1}, surge);
  auto run = open_run((folder / "mps-paper-0.005").string() + "/");
  EXPECT_EQ(run.name, "mps-paper-0.005");
  EXPECT_EQ(run.kind, SourceKind::particle_run);
  EXPECT_EQ(run.method, "mps");
  EXPECT_EQ(run.preset, "paper");
  EXPECT_DOUBLE_EQ(run.physics.column_width().value(), 0.145);
  EXPECT_DOUBLE_EQ(run.physics.far_wall().value().value(), 0.58);
  ASSERT_EQ(run.frames->times().size(), 3U);
  const auto frame =
      std::get<ParticleFrame>(run.frames->read(2, {.pressure = true, .velocity = true}));
  EXPECT_EQ(frame.pressure.size(), frame.position.size());
  EXPECT_DOUBLE_EQ(frame.pressure[3], 300.0);
  EXPECT_DOUBLE_EQ(frame.velocity[3][1], 2.0);
  EXPECT_TRUE(std::get<ParticleFrame>(run.frames->read(0, {})).pressure.empty());
  const FrontHistory history = measure_front(run, {});
  for (std::size_t i = 0; i < history.size(); ++i) {
    EXPECT_NEAR(history[i].position.value(), surge(run.frames->times()[i].value()), 1e-12);
  }
  EXPECT_EQ(open_run(folder / "mps-paper-0.005/particles.pvd").name, "mps-paper-0.005");
}

// Nothing outside of a run's folder is a part of it; the folder itself may be a link.
TEST(ParticleRun, LinksLeadNowhereElse) {
  for (const char* name : {"manifest.json", "steps.csv"}) {
    const TemporaryFolder folder;
    nlohmann::json manifest = testing::dam_break_manifest();
    manifest["frames"] = 2;
    manifest["steps"] = 2;
    write_run(folder / "run", {0.0, 1.0}, surge, manifest);
    write_text(folder / "run/steps.csv", "step\n1\n2\n");
    std::filesystem::create_directory_symlink("run", folder / "link");
    EXPECT_EQ(open_run(folder / "link").name, "link");
    std::filesystem::rename(folder / "run" / name, folder / name);
    std::filesystem::create_symlink(folder / name, folder / "run" / name);
    EXPECT_THAT(error_of([&] { (void)open_run(folder / "run"); }),
                HasSubstr(std::string(name) + ": leads out of"));
    std::filesystem::remove(folder / "run" / name);
    std::filesystem::create_symlink(name, folder / "run" / name);
    EXPECT_NE(error_of([&] { (void)open_run(folder / "run"); }), "") << "a link to itself";
  }
}

TEST(ParticleRun, WhatARunWarnsOfIsANotice) {
  const TemporaryFolder folder;
  nlohmann::json manifest = testing::dam_break_manifest();
  manifest["warnings"] = {"a particle reached 133 m/s"};
  write_run(folder / "run", {0.0, 1.0}, surge, manifest);
  EXPECT_THAT(open_run(folder / "run").notices,
              ::testing::Contains("the run warns: a particle reached 133 m/s"));
  manifest["warnings"] = {1};
  write_run(folder / "run", {0.0, 1.0}, surge, manifest);
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "run"); }),
              HasSubstr("warnings: [1] found, a list of texts expected"));
}

TEST(ParticleRun, WallsAreNotWater) {
  const TemporaryFolder folder;
  write_run(folder / "run", {0.0, 0.1}, surge);
  auto run = open_run(folder / "run");
  FrontOptions raw;
  raw.raw_maximum = true;
  EXPECT_NEAR(measure_front(run, raw)[0].position.value(), 0.145,
              1e-12);  // a wall particle stands at 0.5825
}

TEST(ParticleRun, NotFiniteParticlesAreCounted) {
  const TemporaryFolder folder;
  write_run(folder / "run", {0.0, 0.1}, surge);
  auto points = lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005);
  points.push_back({std::nan(""), 0, 0});
  write_vtp(folder / "run/frames/particles_1.vtp", points, {});
  const auto frame = std::get<ParticleFrame>(open_run(folder / "run").frames->read(1, {}));
  EXPECT_EQ(frame.nonfinite, 1U);
  EXPECT_EQ(frame.position.size(), 1682U);
}

TEST(ParticleRun, FrontEndsWhereTheMainBodyLeavesTheFloor) {
  const TemporaryFolder folder;
  write_run(folder / "run", {0.0, 0.1, 0.2}, surge);
  write_vtp(folder / "run/frames/particles_1.vtp", lattice({0, 0.5, 0}, {0.1, 0.6, 0}, 0.005), {});
  auto run = open_run(folder / "run");
  EXPECT_EQ(measure_front(run, {}).size(), 1U);
}

TEST(ParticleRun, BrokenFilesAreNamed) {
  const TemporaryFolder folder;
  const auto broken = [&](const std::function<void()>& damage) {
    std::filesystem::remove_all(folder / "run");
    write_run(folder / "run", {0.0, 0.1}, surge);
    damage();
    return error_of([&] {
      auto run = open_run(folder / "run");
      (void)measure_front(run, {});
    });
  };
  const auto frame = folder / "run/frames/particles_1.vtp";
  EXPECT_THAT(broken([&] { std::filesystem::remove(frame); }),
              HasSubstr("particles_1.vtp: no such file"));
  EXPECT_THAT(
      broken([&] { std::filesystem::resize_file(frame, std::filesystem::file_size(frame) / 2); }),
      HasSubstr("particles_1.vtp: "));
  EXPECT_THAT(broken([&] { write_text(frame, "nonsense"); }), HasSubstr("particles_1.vtp: "));
  EXPECT_THAT(broken([&] {
                write_vtp(frame, {{0, 0, 0}}, {0}, "kind");
              }),
              HasSubstr("point array type: none found"));
  EXPECT_THAT(broken([&] { write_vtp(frame, {{0, 0, 0}}, {1}); }), HasSubstr("no fluid particle"));
  EXPECT_THAT(broken([&] { std::filesystem::remove(folder / "run/particles.pvd"); }),
              HasSubstr("particles.pvd: found no such file"));
  EXPECT_THAT(broken([&] { write_text(folder / "run/particles.pvd", "<VTKFile><Collection>"); }),
              HasSubstr("particles.pvd: "));
  EXPECT_THAT(broken([&] { write_text(folder / "run/manifest.json", "{"); }),
              HasSubstr("manifest.json: not JSON"));
}

TEST(RunNames, DifferByAsManyParentsAsNeeded) {
  EXPECT_THAT(run_names({"/a/x/out", "/b/x/out", "/b/y", "/b/y/"}),
              ::testing::ElementsAre("a/x/out", "b/x/out", "y", "y"));
  EXPECT_THAT(run_names({"/out", "/a/out", "/in"}), ::testing::ElementsAre("out", "a/out", "in"));
  EXPECT_THAT(run_names({"/a/o", "/b/no"}), ::testing::ElementsAre("o", "no"));
}

TEST(Manifest, EveryMissingOrWrongKeyIsNamed) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& patch) {
    const auto manifest =
        testing::dam_break_manifest().patch(nlohmann::json::parse("[" + patch + "]"));
    write_run(folder / "run", {0.0, 0.1}, surge, manifest);
    return error_of([&] { (void)open_run(folder / "run"); });
  };
  EXPECT_THAT(refused(R"({"op": "remove", "path": "/case"})"), HasSubstr("case: nothing found"));
  EXPECT_THAT(refused(R"({"op": "remove", "path": "/case/fluid/gravity"})"),
              HasSubstr("case.fluid.gravity: nothing found"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/case/fluid/density", "value": "heavy"})"),
              HasSubstr("case.fluid.density: \"heavy\" found"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/case/blocks", "value": []})"),
              HasSubstr("case.blocks: []"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/case/spacing", "value": 0})"),
              HasSubstr("case.spacing: 0"));
  EXPECT_THAT(refused(R"({"op": "replace", "path": "/case/dimension", "value": 4})"),
              HasSubstr("case.dimension: 4"));
}

SourceOptions foreign() {
  SourceOptions options;
  options.spacing = Metres(0.005);
  options.gravity = 9.81;
  return options;
}

TEST(ForeignParticles, AreReadByPatternWithTheirOwnNames) {
  const TemporaryFolder folder;
  for (int i = 0; i < 12; ++i) {  // 10 sorts after 9, not after 1
    auto points = lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005);
    testing::append(points, lattice({0.145, 0, 0}, {0.15 + 0.01 * i, 0.01, 0}, 0.005));
    std::vector<int> type(points.size(), 7);
    points.push_back({0.9, 0, 0});
    type.push_back(2);
    write_vtp(folder / ("fluid_" + std::to_string(i) + ".vtp"), points, type, "mk", 0.02 * i);
  }
  write_vtp(folder / "wall_0.vtp", {{0, 0, 0}}, {2}, "mk", 0.0);
  SourceOptions options = foreign();
  options.type_array = "mk";
  options.type_required = true;
  options.fluid_type = 7;
  options.tank_width = Metres(0.58);
  options.column_width = Metres(0.145);
  auto run = open_run(folder / "fluid_*.vtp", options);
  EXPECT_EQ(run.kind, SourceKind::particle_series);
  EXPECT_EQ(run.physics.dimension, 2);
  EXPECT_NEAR(run.physics.far_wall().value().value(), 0.58, 1e-12);
  EXPECT_NEAR(run.physics.floor(), 0.0, 1e-12);
  const FrontHistory history = measure_front(run, {});
  ASSERT_EQ(history.size(), 12U);
  EXPECT_NEAR(history[11].time.value(), 0.22, 1e-12);
  EXPECT_NEAR(history[11].position.value(), 0.26, 1e-12);

  options.time_step = Seconds(0.5);
  EXPECT_NEAR(open_run(folder / "fluid_*.vtp", options).frames->times()[2].value(), 1.0, 1e-12);
  // The names tell the fluid from the wall.
  EXPECT_EQ(testing::refusal_of([&] { (void)open_run(folder.path(), options); }), "");
}

TEST(ForeignParticles, ColumnIsTakenFromTheFirstFrame) {
  const TemporaryFolder folder;
  write_vtp(folder / "p0.vtp", lattice({1.0, -0.5, 0}, {1.2, -0.1, 0}, 0.005), {}, "x", 0.0);
  write_vtp(folder / "p1.vtp", lattice({1.0, -0.5, 0}, {1.3, -0.2, 0}, 0.005), {}, "x", 0.1);
  auto run = open_run(folder.path(), foreign());
  EXPECT_NEAR(run.physics.column_width().value(), 0.2, 1e-12);
  EXPECT_NEAR(run.physics.floor(), -0.5, 1e-12);
  EXPECT_NEAR(measure_front(run, {})[1].position.value(), 0.3, 1e-12);
  EXPECT_FALSE(run.physics.far_wall().has_value());
}

TEST(ForeignParticles, LegacyFilesAreRead) {
  const TemporaryFolder folder;
  for (int i = 0; i < 2; ++i) {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    for (const Vec3& x : lattice({0, 0, 0}, {0.1 + 0.05 * i, 0.1, 0}, 0.005))
      points->InsertNextPoint(x.data());
    data->SetPoints(points);
    vtkNew<vtkDataSetWriter> writer;
    writer->SetFileName((folder / ("PartFluid_000" + std::to_string(i) + ".vtk")).c_str());
    writer->SetFileTypeToBinary();
    writer->SetInputData(data);
    writer->Write();
  }
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign()); }),
              HasSubstr("--time-step"));
  SourceOptions options = foreign();
  options.time_step = Seconds(0.1);
  auto run = open_run(folder.path(), options);
  EXPECT_NEAR(measure_front(run, {})[1].position.value(), 0.15, 1e-7);
}

TEST(ForeignParticles, WhatCannotBeKnownMustBeSaid) {
  const TemporaryFolder folder;
  write_vtp(folder / "p0.vtp", lattice({0, 0, 0}, {0.1, 0.1, 0}, 0.005), {}, "x", 0.5);
  SourceOptions options = foreign();
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }),
              HasSubstr("--column-width"));
  options.column_width = Metres(0.1);
  EXPECT_NO_THROW((void)open_run(folder.path(), options));
  options.spacing.reset();
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }), HasSubstr("--spacing"));
  options = foreign();
  options.gravity.reset();
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), options); }), HasSubstr("--gravity"));
}

TEST(ForeignParticles, TimesMustIncrease) {
  const TemporaryFolder folder;
  write_vtp(folder / "p0.vtp", lattice({0, 0, 0}, {0.1, 0.1, 0}, 0.005), {}, "x", 0.0);
  write_vtp(folder / "p1.vtp", lattice({0, 0, 0}, {0.1, 0.1, 0}, 0.005), {}, "x", 0.0);
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path(), foreign()); }),
              HasSubstr("p1.vtp: time 0"));
}

TEST(OpenRun, SaysWhatItExpected) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "no"); }),
              HasSubstr("no such file or folder"));
  EXPECT_THAT(error_of([&] { (void)open_run(folder.path()); }), HasSubstr("neither manifest.json"));
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "a_*.vtp"); }), HasSubstr("no frame found"));
  const auto text = write_text(folder / "a.xyz", "x");
  EXPECT_THAT(error_of([&] { (void)open_run(text); }),
              HasSubstr("a .pvd, a .series, a folder, a pattern"));
  write_run(folder / "run", {0.0, 0.1}, surge);
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "run", foreign()); }),
              HasSubstr("states the case"));
  write_text(folder / "case/system/controlDict", "");
  EXPECT_THAT(error_of([&] { (void)open_run(folder / "case"); }),
              HasSubstr("no constant/polyMesh"));
}

}  // namespace
}  // namespace surge::compare
