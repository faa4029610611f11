#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>

#include "compare/measure/measure_all.hpp"
#include "compare/measure/registry.hpp"
#include "tests/compare/measure/frames_in_memory.hpp"

namespace surge::compare {
namespace {

using testing::box_mesh;
using testing::lattice;
using testing::MemoryRun;

constexpr double l0 = 0.01;
constexpr double density = 800.0;

/// Values of one observable at the only frame.
std::vector<double> measured(Frame frame, const Physics& physics, const std::string& request) {
  MemoryRun memory({std::move(frame)}, physics, l0);
  std::vector<std::unique_ptr<Observable>> one;
  one.push_back(make_observable(request, {memory.run, {}, nullptr}));
  const auto found = measure_all(memory.run, one);
  EXPECT_FALSE(found[0].failure) << found[0].failure.value_or("");
  std::vector<double> values;
  for (const TimeSeries& series : found[0].series) values.push_back(series.values.at(0).value());
  return values;
}

/// A block of water, 0.1 to 0.3 m along x and 0.05 to 0.25 m high, 0.2 m wide in 3D, in a tank
/// whose floor is at 0; a drop of 0.02 m at x = 0.5, 0.3 m high. Speed: (1 + x) along x, 2 upwards.
struct Block {
  Physics physics = testing::dam_break();
  Frame particles, mesh;

  Block(int dimension, std::size_t up) {
    physics.dimension = dimension;
    physics.density = density;
    physics.gravity = {};
    physics.gravity[up] = -10.0;
    Vec3 tank{1.0, 0.2, 0.2};
    tank[up] = 0.4;
    if (dimension == 2) tank[3 - up] = 0.0;
    physics.tank = Extent{{0, 0, 0}, tank};
    physics.column = *physics.tank;
    const auto inside = [up](const Vec3& x) {
      const bool block = x[0] > 0.1 && x[0] < 0.3 && x[up] > 0.05 && x[up] < 0.25;
      const bool drop = x[0] > 0.5 && x[0] < 0.52 && x[up] > 0.3 && x[up] < 0.32;
      return block || drop;
    };
    const auto velocity = [up](const Vec3& x) {
      Vec3 v{1.0 + x[0], 0.0, 0.0};
      v[up] = 2.0;
      return v;
    };
    ParticleFrame frame;
    std::array<int, 3> n{100, 20, 20};
    n[up] = 40;
    if (dimension == 2) n[3 - up] = 1;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          Vec3 x{(i + 0.5) * l0, (j + 0.5) * l0, (k + 0.5) * l0};
          if (!inside(x)) continue;
          frame.velocity.push_back(velocity(x));
          // In 2D the third component means nothing.
          if (dimension == 2) frame.velocity.back()[3 - up] = 7.0;
          frame.position.push_back(x);
        }
    particles = frame;
    Vec3 upper{n[0] * l0, n[1] * l0, n[2] * l0};
    MeshFrame cells = box_mesh(upper, n, [&](const Vec3& x) { return inside(x) ? 1.0 : 0.0; });
    testing::add_velocity(cells, [&](const Vec3& x) {
      Vec3 v = velocity(x);
      if (dimension == 2) v[3 - up] = 7.0;
      return v;
    });
    mesh = cells;
  }
  [[nodiscard]] double width() const { return physics.dimension == 3 ? 0.2 : 1.0; }
};

/// Both sides, every dimension and vertical axis.
void for_all(const std::function<void(const Block&, const Frame&, std::size_t)>& check) {
  for (const int dimension : {2, 3}) {
    for (const std::size_t up : {1U, 2U}) {
      SCOPED_TRACE(std::to_string(dimension) + "D, axis " + std::to_string(up));
      const Block block(dimension, up);
      check(block, block.particles, up);
      check(block, block.mesh, up);
    }
  }
}

constexpr double block_area = 0.2 * 0.2, drop_area = 0.02 * 0.02;

TEST(Integrals, VolumeHoldsTheDropToo) {
  for_all([](const Block& block, const Frame& frame, std::size_t) {
    EXPECT_NEAR(measured(frame, block.physics, "volume")[0],
                (block_area + drop_area) * block.width(), 1e-12);
  });
}

TEST(Integrals, CentreOfMass) {
  for_all([](const Block& block, const Frame& frame, std::size_t up) {
    const auto centre = measured(frame, block.physics, "centre-of-mass");
    const double all = block_area + drop_area;
    const double x = (block_area * 0.2 + drop_area * 0.51) / all;
    const double z = (block_area * 0.15 + drop_area * 0.31) / all;
    const bool flat = block.physics.dimension == 2;
    ASSERT_EQ(centre.size(), flat ? 2U : 3U);
    EXPECT_NEAR(centre[0], x, 1e-12);
    EXPECT_NEAR(centre[flat ? 1 : up], z, 1e-12);
    if (!flat) {
      EXPECT_NEAR(centre[3 - up], 0.1, 1e-12);
    }
  });
}

TEST(Integrals, PotentialEnergyCountsFromTheFloor) {
  for_all([](const Block& block, const Frame& frame, std::size_t) {
    const double expected = density * 10.0 * (block_area * 0.15 + drop_area * 0.31) * block.width();
    EXPECT_NEAR(measured(frame, block.physics, "potential-energy")[0], expected, 1e-9);
  });
}

TEST(Integrals, KineticEnergyLeavesTheThirdComponentOutInTwoDimensions) {
  for_all([](const Block& block, const Frame& frame, std::size_t) {
    // Sum over columns of cells i of (1 + x_i)^2 + 4, x_i the middles.
    double sum = 0.0;
    for (int i = 10; i < 30; ++i) sum += 20 * (std::pow(1.0 + (i + 0.5) * l0, 2) + 4.0);
    for (int i = 50; i < 52; ++i) sum += 2 * (std::pow(1.0 + (i + 0.5) * l0, 2) + 4.0);
    const double expected = 0.5 * density * sum * l0 * l0 * block.width();
    EXPECT_NEAR(measured(frame, block.physics, "kinetic-energy")[0], expected, 1e-9);
  });
}

TEST(Integrals, EnergyWithoutADensityAsksForIt) {
  Block block(2, 1);
  block.physics.density.reset();
  const MemoryRun memory({block.particles}, block.physics, l0);
  EXPECT_THAT(testing::error_of([&] {
                (void)make_observable("potential-energy", {memory.run, {}, nullptr});
              }),
              ::testing::HasSubstr("--density"));
}

TEST(MeshTopology, VolumeOfASkewedCellIsExact) {
  // A cube whose top is moved along x by half of its edge keeps its volume; the box around is
  // larger.
  MeshFrame frame = box_mesh({1, 1, 1}, {1, 1, 1}, [](const Vec3&) { return 1.0; });
  for (vtkIdType i = 4; i < 8; ++i) {
    Vec3 x;
    frame.grid->GetPoint(i, x.data());
    frame.grid->GetPoints()->SetPoint(i, x[0] + 0.5, x[1], x[2]);
  }
  const MeshTopology mesh(*frame.grid);
  EXPECT_NEAR(mesh.volume[0], 1.0, 1e-12);
  EXPECT_NEAR(mesh.centre[0][0], 0.75, 1e-12);
  EXPECT_NEAR(mesh.box[0].upper[0], 1.5, 1e-12);
}

}  // namespace
}  // namespace surge::compare
