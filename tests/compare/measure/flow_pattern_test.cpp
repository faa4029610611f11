#include "compare/measure/flow_pattern.hpp"

#include <gtest/gtest.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::append;
using testing::box_mesh;
using testing::dam_break;
using testing::lattice;
using testing::particles;
using testing::view_of;

Run particle_run(double l0) {
  Run run;
  run.physics = dam_break();
  run.spacing = Metres(l0);
  return run;
}

Run mesh_run(double cell) {
  Run run = particle_run(cell);
  run.kind = SourceKind::openfoam;
  return run;
}

/// A dam break in 3D, z upwards or y upwards: column 0.1 x 0.05 x 0.2 in a tank 0.4 x 0.05 x 0.4.
Physics dam_break_3d(std::size_t up) {
  Physics physics = dam_break();
  physics.dimension = 3;
  physics.gravity = {};
  physics.gravity[up] = -9.81;
  physics.column = {{0, 0, 0}, {0.1, 0.05, 0.05}};
  physics.column.upper[up] = 0.2;
  physics.tank = Extent{{0, 0, 0}, {0.4, 0.05, 0.05}};
  physics.tank->upper[up] = 0.4;
  return physics;
}

FractionGrid grid_of(const Frame& frame, const Physics& physics, double spacing, double cell) {
  FractionGrid grid(physics, Metres(cell));
  grid.add(view_of(frame, physics, spacing));
  return grid;
}

TEST(FractionGrid, KeepsTheAreaOfTheWater) {
  const FractionGrid grid =
      grid_of(particles(lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005)), dam_break(), 0.005, 0.00725);
  EXPECT_NEAR(grid.volume(), 0.145 * 0.29, 1e-12);
  const FractionGrid of_mesh =
      grid_of(box_mesh({0.58, 0.58, 0.01}, {40, 40, 1},
                       [](const Vec3& x) { return x[0] < 0.145 && x[1] < 0.29 ? 0.75 : 0.0; }),
              dam_break(), 0.0145, 0.00725);
  EXPECT_NEAR(of_mesh.volume(), 0.75 * 0.145 * 0.29, 1e-12);
}

TEST(FractionGrid, KeepsTheVolumeInThreeDimensions) {
  for (const std::size_t up : {1U, 2U}) {
    const Physics physics = dam_break_3d(up);
    const FractionGrid grid =
        grid_of(particles(lattice({0, 0, 0}, physics.column.upper, 0.005)), physics, 0.005, 0.01);
    EXPECT_NEAR(grid.volume(), 0.1 * 0.05 * 0.2, 1e-12);
  }
}

TEST(FractionGrid, TellsTheBoxOfEachCell) {
  // The tank is 0.58 m wide: 40 columns.
  const FractionGrid flat(dam_break(), Metres(0.0145));
  const Extent box = flat.box_of(2 * 40 + 3);
  EXPECT_NEAR(box.lower[0], 3 * 0.0145, 1e-12);
  EXPECT_NEAR(box.upper[0], 4 * 0.0145, 1e-12);
  EXPECT_NEAR(box.lower[1], 2 * 0.0145, 1e-12);
  EXPECT_NEAR(box.upper[1], 3 * 0.0145, 1e-12);
  for (const std::size_t up : {1U, 2U}) {
    // The only wet cell of a full one is where the water is.
    const Physics physics = dam_break_3d(up);
    const Vec3 corner{0.03, 0.02, 0.02};
    const FractionGrid grid =
        grid_of(particles(lattice(corner, {0.04, 0.03, 0.03}, 0.005)), physics, 0.005, 0.01);
    std::size_t wet = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (!grid.wet(i)) continue;
      ++wet;
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(grid.box_of(i).lower[a], corner[a], 1e-12);
        EXPECT_NEAR(grid.box_of(i).upper[a], corner[a] + 0.01, 1e-12);
      }
    }
    EXPECT_EQ(wet, 1U);
  }
}

TEST(Overlap, OfARegionMovedByAFifthOfItsWidth) {
  const auto region = [&](double x) {
    return grid_of(particles(lattice({x, 0, 0}, {x + 0.145, 0.29, 0}, 0.0145)), dam_break(), 0.0145,
                   0.0145);
  };
  EXPECT_NEAR(overlap(region(0.0), region(0.0)), 1.0, 1e-12);
  // Eight columns of ten in both, twelve in either one.
  EXPECT_NEAR(overlap(region(0.0), region(0.029)), 8.0 / 12.0, 1e-12);
  EXPECT_NEAR(overlap(region(0.0), region(0.29)), 0.0, 1e-12);
}

TEST(Overlap, ParticlesAgainstAMeshOfTheSameWater) {
  const FractionGrid a =
      grid_of(particles(lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005)), dam_break(), 0.005, 0.00725);
  const FractionGrid b =
      grid_of(box_mesh({0.58, 0.58, 0.01}, {80, 80, 1},
                       [](const Vec3& x) { return x[0] < 0.145 && x[1] < 0.29 ? 1.0 : 0.0; }),
              dam_break(), 0.00725, 0.00725);
  EXPECT_NEAR(overlap(a, b), 1.0, 1e-12);
}

TEST(Overlap, InThreeDimensionsOfAMeshMovedAcross) {
  // The particles fill the width, the mesh three fifths of it: cells in both over cells in either.
  const Physics physics = dam_break_3d(2);
  const FractionGrid a =
      grid_of(particles(lattice({0, 0, 0}, {0.1, 0.05, 0.2}, 0.005)), physics, 0.005, 0.01);
  const FractionGrid b = grid_of(
      box_mesh({0.4, 0.05, 0.4}, {40, 5, 40},
               [](const Vec3& x) { return x[0] < 0.1 && x[1] < 0.03 && x[2] < 0.2 ? 1.0 : 0.0; }),
      physics, 0.01, 0.01);
  EXPECT_NEAR(b.volume(), 0.1 * 0.03 * 0.2, 1e-12);
  EXPECT_NEAR(overlap(a, b), 0.6, 1e-12);
}

TEST(OverlapCell, IsNoFinerThanEitherRun) {
  EXPECT_NEAR(overlap_cell(particle_run(0.005), mesh_run(0.00725)).value(), 0.00725, 1e-12);
  EXPECT_NEAR(overlap_cell(particle_run(0.0145), mesh_run(0.00725)).value(), 0.0145, 1e-12);
  EXPECT_NEAR(overlap_cell(particle_run(0.006), mesh_run(0.006)).value(), 0.145 / 24, 1e-12);
}

TEST(Detached, ParticlesByTheLinkingLength) {
  const double l0 = 0.005;
  std::vector<Vec3> position = lattice({0, 0, 0}, {0.1, 0.1, 0}, l0);  // 400
  // A drop of 100 whose nearest particle is 2.2 spacings away.
  append(position, lattice({0.1 + 1.2 * l0, 0, 0}, {0.15 + 1.2 * l0, 0.05, 0}, l0));
  FrameView frame = view_of(particles(position), dam_break(), l0);
  const Detached usual = detached(frame);
  EXPECT_EQ(usual.pieces, 1U);
  EXPECT_NEAR(usual.part, 0.2, 1e-12);
  EXPECT_EQ(detached(frame, {.linking_length = 2.5}).pieces, 0U);
  EXPECT_EQ(detached(frame, {.linking_length = 0.9}).pieces, 499U);
}

TEST(Detached, MeshByTheLevelAtTheCorners) {
  // Body of 10 x 10 cells, a drop of 4 x 4 and a film of one cell's width.
  const MeshFrame frame = box_mesh({1, 1, 0.02}, {50, 50, 1}, [](const Vec3& x) {
    const bool body = x[0] < 0.2 && x[1] < 0.2;
    const bool drop = x[0] > 0.5 && x[0] < 0.58 && x[1] > 0.5 && x[1] < 0.58;
    const bool film = x[0] > 0.8 && x[0] < 0.82 && x[1] > 0.3 && x[1] < 0.7;
    return body || drop || (film && x[1] > 0.0) ? 1.0 : 0.0;
  });
  FrameView view = view_of(frame, dam_break(), 0.02);
  const Detached strict = detached(view, {.corner_level = 0.75});
  EXPECT_EQ(strict.pieces, 1U);
  const Detached usual = detached(view);
  EXPECT_EQ(usual.pieces, 2U);
  EXPECT_GT(usual.part, strict.part);
  EXPECT_NEAR(usual.part + usual.blurred, 1.0 - 100.0 / 136.0, 0.02);
}

TEST(Detached, InThreeDimensions) {
  const Physics physics = dam_break_3d(2);
  // 8 x 4 x 4 cells of a body and 2 x 2 x 2 of a drop, 64 particles to a cell of 0.02 m.
  std::vector<Vec3> position = lattice({0, 0, 0}, {0.16, 0.08, 0.08}, 0.005);
  append(position, lattice({0.24, 0, 0.1}, {0.28, 0.04, 0.14}, 0.005));
  FrameView frame = view_of(particles(position), physics, 0.005);
  EXPECT_EQ(detached(frame).pieces, 1U);
  EXPECT_NEAR(detached(frame).part, 8.0 / 136.0, 1e-12);
  const MeshFrame cells = box_mesh({0.4, 0.08, 0.4}, {20, 4, 20}, [](const Vec3& x) {
    const bool body = x[0] < 0.16 && x[2] < 0.08;
    const bool drop = x[0] > 0.24 && x[0] < 0.28 && x[1] < 0.04 && x[2] > 0.1 && x[2] < 0.14;
    return body || drop ? 1.0 : 0.0;
  });
  FrameView mesh = view_of(cells, physics, 0.02);
  const Detached found = detached(mesh);
  EXPECT_EQ(found.pieces, 1U);
  EXPECT_NEAR(found.part + found.blurred, 8.0 / 136.0, 0.02);
}

TEST(SmallestDistance, IsThatOfTheNearestPair) {
  std::vector<Vec3> position = lattice({0, 0, 0}, {0.1, 0.1, 0}, 0.005);
  EXPECT_NEAR(*smallest_distance(position), 0.005, 1e-12);
  position.push_back({0.0525, 0.0535, 0});
  EXPECT_NEAR(*smallest_distance(position), 0.001, 1e-12);
  EXPECT_FALSE(smallest_distance({{0, 0, 0}}));
}

}  // namespace
}  // namespace surge::compare
