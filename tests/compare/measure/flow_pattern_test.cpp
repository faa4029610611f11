#include "compare/measure/flow_pattern.hpp"

#include <gtest/gtest.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::append;
using testing::box_mesh;
using testing::dam_break;
using testing::lattice;

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

ParticleFrame particles(std::vector<Vec3> position) {
  ParticleFrame frame;
  frame.position = std::move(position);
  return frame;
}

TEST(FractionGrid, KeepsTheAreaOfTheWater) {
  FractionGrid grid(dam_break(), Metres(0.00725));
  grid.add(particles(lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005)), particle_run(0.005));
  EXPECT_NEAR(grid.area(), 0.145 * 0.29, 1e-12);
  FractionGrid of_mesh(dam_break(), Metres(0.00725));
  of_mesh.add(box_mesh({0.58, 0.58, 0.01}, {40, 40, 1},
                       [](const Vec3& x) { return x[0] < 0.145 && x[1] < 0.29 ? 0.75 : 0.0; }),
              mesh_run(0.0145));
  EXPECT_NEAR(of_mesh.area(), 0.75 * 0.145 * 0.29, 1e-12);
}

TEST(Overlap, OfARegionMovedByAFifthOfItsWidth) {
  const Physics physics = dam_break();
  const auto region = [&](double x) {
    FractionGrid grid(physics, Metres(0.0145));
    grid.add(particles(lattice({x, 0, 0}, {x + 0.145, 0.29, 0}, 0.0145)), particle_run(0.0145));
    return grid;
  };
  EXPECT_NEAR(overlap(region(0.0), region(0.0)), 1.0, 1e-12);
  // Eight columns of ten in both, twelve in either one.
  EXPECT_NEAR(overlap(region(0.0), region(0.029)), 8.0 / 12.0, 1e-12);
  EXPECT_NEAR(overlap(region(0.0), region(0.29)), 0.0, 1e-12);
}

TEST(Overlap, ParticlesAgainstAMeshOfTheSameWater) {
  FractionGrid a(dam_break(), Metres(0.00725)), b(dam_break(), Metres(0.00725));
  a.add(particles(lattice({0, 0, 0}, {0.145, 0.29, 0}, 0.005)), particle_run(0.005));
  b.add(box_mesh({0.58, 0.58, 0.01}, {80, 80, 1},
                 [](const Vec3& x) { return x[0] < 0.145 && x[1] < 0.29 ? 1.0 : 0.0; }),
        mesh_run(0.00725));
  EXPECT_NEAR(overlap(a, b), 1.0, 1e-12);
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
  const ParticleFrame frame = particles(position);
  const Detached usual = detached(frame, Metres(l0), 2.0);
  EXPECT_EQ(usual.pieces, 1U);
  EXPECT_NEAR(usual.part, 0.2, 1e-12);
  EXPECT_EQ(detached(frame, Metres(l0), 2.5).pieces, 0U);
  EXPECT_EQ(detached(frame, Metres(l0), 0.9).pieces, 499U);
}

TEST(Detached, MeshByTheLevelAtTheCorners) {
  // Body of 10 x 10 cells, a drop of 4 x 4 and a film of one cell's width.
  const MeshFrame frame = box_mesh({1, 1, 0.02}, {50, 50, 1}, [](const Vec3& x) {
    const bool body = x[0] < 0.2 && x[1] < 0.2;
    const bool drop = x[0] > 0.5 && x[0] < 0.58 && x[1] > 0.5 && x[1] < 0.58;
    const bool film = x[0] > 0.8 && x[0] < 0.82 && x[1] > 0.3 && x[1] < 0.7;
    return body || drop || (film && x[1] > 0.0) ? 1.0 : 0.0;
  });
  MeshFront mesh;
  const Detached strict = detached(mesh, frame, 0.75);
  EXPECT_EQ(strict.pieces, 1U);
  const Detached usual = detached(mesh, frame, 0.5);
  EXPECT_EQ(usual.pieces, 2U);
  EXPECT_GT(usual.part, strict.part);
  EXPECT_NEAR(usual.part + usual.blurred, 1.0 - 100.0 / 136.0, 0.02);
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
