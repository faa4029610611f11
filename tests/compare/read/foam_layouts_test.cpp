#include <gmock/gmock.h>

#include "tests/compare/foam_dam.hpp"

namespace surge::compare {
namespace {

using ::testing::Contains;
using testing::expect_foam_front;
using testing::foam_tank;
using testing::foam_water;
using testing::FoamCaseWriter;
using testing::FoamLayout;
using testing::FoamTestTank;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TemporaryFolder;

/// All ways in which OpenFOAM writes one and the same case.
class FoamLayouts : public ::testing::TestWithParam<std::pair<const char*, FoamLayout>> {};

TEST_P(FoamLayouts, GiveTheSameFrontIn2D) {
  const TemporaryFolder folder;
  FoamCaseWriter(folder / "case", foam_tank(), GetParam().second).write(foam_water);
  expect_foam_front(folder / "case", 3);
  EXPECT_THAT(open_run(folder / "case").frames->notices(), IsEmpty());
}

TEST_P(FoamLayouts, GiveTheSameFrontIn3D) {
  const TemporaryFolder folder;
  FoamCaseWriter(folder / "case", foam_tank(3), GetParam().second).write(foam_water);
  expect_foam_front(folder / "case", 3);
  const auto run = open_run(folder / "case");
  EXPECT_EQ(run.physics.dimension, 3);
  EXPECT_DOUBLE_EQ(run.physics.tank->upper[2], 0.03);
}

INSTANTIATE_TEST_SUITE_P(
    Writers, FoamLayouts,
    ::testing::Values(
        std::pair("Ascii", FoamLayout{}), std::pair("Binary", FoamLayout{.binary = true}),
        std::pair("Packed", FoamLayout{.packed = true}),
        std::pair("BinaryPacked", FoamLayout{.binary = true, .packed = true}),
        std::pair("Decomposed", FoamLayout{.processors = 4}),
        std::pair("BinaryDecomposed", FoamLayout{.binary = true, .processors = 3}),
        std::pair("PackedDecomposed", FoamLayout{.packed = true, .processors = 2}),
        std::pair("Collated", FoamLayout{.processors = 4, .collated = true}),
        std::pair("BinaryCollated", FoamLayout{.binary = true, .processors = 3, .collated = true}),
        std::pair("Grouped",
                  FoamLayout{.binary = true, .processors = 4, .collated = true, .grouped = true})),
    [](const auto& given) { return std::string(given.param.first); });

TEST(FoamRefined, MeshesOfPolyhedraGiveTheSameFrontIn2D) {
  const TemporaryFolder folder;
  // Small cells ahead of x = 0.05 m at the floor, where the front runs.
  const auto refined = [](std::array<int, 3> c) { return c[0] >= 5 && c[1] < 10; };
  for (const int processors : {1, 3}) {
    const auto path = folder / std::to_string(processors);
    FoamCaseWriter(path, foam_tank(1, refined), FoamLayout{.processors = processors})
        .write(foam_water);
    SourceOptions options;
    options.spacing = Metres(0.01);
    expect_foam_front(path, 3, options);
  }
  EXPECT_THAT(open_run(folder / "1").frames->notices(),
              Contains(HasSubstr("cells are 0.005 to 0.01")));
}

TEST(FoamRefined, MeshesOfPolyhedraGiveTheSameFrontIn3D) {
  const TemporaryFolder folder;
  const auto refined = [](std::array<int, 3> c) { return c[0] >= 5 && c[1] < 10; };
  FoamCaseWriter(folder / "case", foam_tank(2, refined), FoamLayout{.binary = true})
      .write(foam_water);
  SourceOptions options;
  options.spacing = Metres(0.01);
  expect_foam_front(folder / "case", 3, options);
}

TEST(FoamRefined, MeshThatChangesInTimeIsReadForEachTime) {
  const TemporaryFolder folder;
  const FoamLayout layout;
  const FoamCaseWriter coarse(folder / "case", foam_tank(), layout);
  coarse.write(foam_water);
  const auto refined = [](std::array<int, 3> c) { return c[0] >= 15 && c[1] < 12; };
  const FoamCaseWriter fine(folder / "case", foam_tank(1, refined), layout);
  fine.write_mesh("0.1");
  fine.write_field("0.1", foam_water);
  fine.write_field("0.2", foam_water);
  expect_foam_front(folder / "case", 3);
}

TEST(FoamRefined, PointsThatMoveAreReadForEachTime) {
  const TemporaryFolder folder;
  FoamCaseWriter(folder / "case", foam_tank(), FoamLayout{}).write(foam_water);
  // The whole tank is carried along by 0.1 m: the front moves with it.
  FoamLayout moved;
  moved.place = [](Vec3 x) { return Vec3{x[0] + 0.1, x[1], x[2]}; };
  const FoamCaseWriter writer(folder / "moved", foam_tank(), moved);
  writer.write(foam_water);
  std::filesystem::create_directories(folder / "case/0.2/polyMesh");
  std::filesystem::copy_file(folder / "moved/constant/polyMesh/points",
                             folder / "case/0.2/polyMesh/points");
  auto run = open_run(folder / "case");
  const FrontHistory front = measure_front(run, {});
  ASSERT_EQ(front.size(), 3U);
  EXPECT_NEAR(front[1].position.value(), testing::foam_edge(0.1), 1e-9);
  EXPECT_NEAR(front[2].position.value(), 0.1 + testing::foam_edge(0.2), 1e-9);
}

TEST(FoamAxes, StatedOnesMustFitTheGravity) {
  const TemporaryFolder folder;
  FoamCaseWriter(folder / "case", foam_tank(3), {}).write(foam_water);
  const auto axes = [](const std::vector<std::string>& words) {
    SourceOptions options;
    options.axes = FileAxes::parse(words, "axes");
    return options;
  };
  expect_foam_front(folder / "case", 3, axes({"x", "y"}));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"x", "z"}, {"x", "-y"}, {"-x", "z"}})
    EXPECT_THAT(testing::error_of([&] { (void)open_run(folder / "case", axes(words)); }),
                ::testing::HasSubstr("points up by the case's gravity"));
  // The column then stands at the far end.
  EXPECT_THAT(testing::error_of([&] {
                (void)open_run(folder / "case", axes({"-x", "y"}));
              }),
              ::testing::HasSubstr("reaches the far wall"));
}

/// Where the case's axes lie: x along the surge, y up, z across, as the case has them.
struct Plane {
  const char* name;
  Vec3 (*place)(Vec3);
  Vec3 gravity;
};

class FoamPlanes : public ::testing::TestWithParam<Plane> {};

TEST_P(FoamPlanes, GiveTheSameFrontIn2DAnd3D) {
  for (const int layers : {1, 3}) {
    const TemporaryFolder folder;
    FoamLayout layout;
    layout.place = GetParam().place;
    layout.gravity = GetParam().gravity;
    FoamCaseWriter(folder / "case", foam_tank(layers), layout).write(foam_water);
    expect_foam_front(folder / "case", 3);
    const auto run = open_run(folder / "case");
    EXPECT_EQ(run.physics.dimension, layers == 1 ? 2 : 3);
    EXPECT_NEAR(run.physics.far_wall().value().value(), 0.4, 1e-12);
    EXPECT_DOUBLE_EQ(run.physics.gravity_magnitude(), 9.81);
  }
}

constexpr double g = 9.81;
INSTANTIATE_TEST_SUITE_P(All, FoamPlanes,
                         ::testing::Values(Plane{"XY", [](Vec3 x) { return x; }, {0, -g, 0}},
                                           Plane{"Moved",
                                                 [](Vec3 x) {
                                                   return Vec3{x[0] - 7, x[1] + 3, x[2] - 0.5};
                                                 },
                                                 {0, -g, 0}},
                                           Plane{"XZ",
                                                 [](Vec3 x) {
                                                   return Vec3{x[0], -x[2], x[1]};
                                                 },
                                                 {0, 0, -g}},
                                           Plane{"YZ",
                                                 [](Vec3 x) {
                                                   return Vec3{x[2], x[0], x[1]};
                                                 },
                                                 {0, 0, -g}},
                                           Plane{"YX",
                                                 [](Vec3 x) {
                                                   return Vec3{x[1], x[0], -x[2]};
                                                 },
                                                 {-g, 0, 0}},
                                           Plane{"ZX",
                                                 [](Vec3 x) {
                                                   return Vec3{x[1], x[2], x[0]};
                                                 },
                                                 {-g, 0, 0}},
                                           Plane{"ZY",
                                                 [](Vec3 x) {
                                                   return Vec3{-x[2], x[1], x[0]};
                                                 },
                                                 {0, -g, 0}},
                                           Plane{"ToTheLeft",
                                                 [](Vec3 x) {
                                                   return Vec3{0.4 - x[0], x[1], -x[2]};
                                                 },
                                                 {0, -g, 0}},
                                           Plane{"ToTheLeftXZ",
                                                 [](Vec3 x) {
                                                   return Vec3{-x[0], x[2], x[1]};
                                                 },
                                                 {0, 0, -g}},
                                           Plane{"UpsideDown",
                                                 [](Vec3 x) {
                                                   return Vec3{x[0], -x[1], -x[2]};
                                                 },
                                                 {0, g, 0}}),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace surge::compare
