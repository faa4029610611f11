#include <gtest/gtest.h>

#include "tests/compare/synthetic.hpp"

namespace surge::compare {
namespace {

using testing::append;
using testing::dam_break;
using testing::lattice;

constexpr double l0 = 0.005;
constexpr double width = 0.58;

/// The dam break seen in a mirror: the column stands at x = 4L, the water surges towards x = 0.
Physics mirrored_dam_break() {
  Physics physics = dam_break();
  physics.column = {{width - 0.145, 0, 0}, {width, 0.29, 0}};
  return physics;
}

std::vector<Vec3> mirrored(std::vector<Vec3> points) {
  for (Vec3& x : points) x[0] = width - x[0];
  return points;
}

double edge_of(const Frame& frame, const Physics& physics, const FrontOptions& options = {}) {
  FrameView view = testing::view_of(frame, physics, l0);
  return leading_edge(view, options).value();
}

TEST(SurgeDirection, IsAwayFromTheWallThatTheColumnStandsAt) {
  EXPECT_EQ(dam_break().surge_direction(), 1.0);
  EXPECT_EQ(mirrored_dam_break().surge_direction(), -1.0);
  EXPECT_EQ(mirrored_dam_break().column_wall(), width);
  EXPECT_NEAR(mirrored_dam_break().far_wall()->value(), width, 1e-12);
  Physics full = dam_break();  // from wall to wall: no side is the far one
  full.column.upper[0] = width;
  EXPECT_EQ(full.surge_direction(), 1.0);
  Physics unknown = dam_break();
  unknown.tank.reset();
  EXPECT_EQ(unknown.surge_direction(), 1.0);
}

TEST(MirroredFront, OfParticlesIsTheMirrorImage) {
  for (const double depth : {0.0, 0.05}) {
    ParticleFrame frame, other;
    frame.position = lattice({0, 0, 0}, {0.145, 0.29, depth}, l0);
    append(frame.position, lattice({0.145, 0, 0}, {0.3, 0.01, depth}, l0));
    append(frame.position, lattice({0.4, 0, 0}, {0.41, 0.01, depth}, l0));  // a drop ahead
    other.position = mirrored(frame.position);
    FrontOptions raw;
    raw.raw_maximum = true;
    EXPECT_NEAR(edge_of(frame, dam_break()), 0.3, 1e-12);
    EXPECT_NEAR(edge_of(other, mirrored_dam_break()), width - 0.3, 1e-12);
    EXPECT_NEAR(edge_of(other, mirrored_dam_break(), raw), width - 0.41, 1e-12);
  }
}

TEST(MirroredFront, OfMeshesIsTheMirrorImage) {
  const auto water = [](const Vec3& x) {
    const bool column = x[0] < 0.145 && x[1] < 0.29;
    const bool tongue = x[0] < 0.29 - 2.0 * x[1] && x[1] < 0.0725;
    return column || tongue ? 1.0 : 0.0;
  };
  const auto image = [&](const Vec3& x) { return water({width - x[0], x[1], x[2]}); };
  for (const int layers : {1, 4}) {
    const Vec3 box{width, 0.58, 0.0145 * layers};
    const MeshFrame frame = testing::box_mesh(box, {40, 40, layers}, water, 4);
    const MeshFrame other = testing::box_mesh(box, {40, 40, layers}, image, 4);
    const double edge = edge_of(frame, dam_break());
    EXPECT_GT(edge, 0.2);
    EXPECT_NEAR(edge_of(other, mirrored_dam_break()), width - edge, 1e-12);
  }
}

TEST(MirroredFront, OfARunHasTheSameHistory) {
  const testing::TemporaryFolder folder;
  const std::vector<double> times{0.0, 0.05, 0.1};
  testing::write_run(folder / "a", times, [](double t) { return 0.145 + 2.0 * t; });
  auto run = open_run(folder / "a");
  const FrontHistory history = measure_front(run, {});
  nlohmann::json manifest = testing::dam_break_manifest();
  manifest["case"]["blocks"][0]["lower"] = {width - 0.145, 0, 0};
  manifest["case"]["blocks"][0]["upper"] = {width, 0.29, 0};
  testing::write_run(
      folder / "b", times, [](double) { return 0.145; }, manifest);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto frame = std::get<ParticleFrame>(run.frames->read(i, {}));
    testing::write_vtp(folder / ("b/frames/particles_" + std::to_string(i) + ".vtp"),
                       mirrored(frame.position), {});
  }
  auto image = open_run(folder / "b");
  const FrontHistory other = measure_front(image, {});
  ASSERT_EQ(other.size(), history.size());
  for (std::size_t i = 0; i < history.size(); ++i)
    EXPECT_NEAR(other[i].position.value(), history[i].position.value(), 1e-12);
}

}  // namespace
}  // namespace surge::compare
