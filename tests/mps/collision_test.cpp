#include <gtest/gtest.h>

#include <cmath>

#include "particle/mps/collision.hpp"
#include "tests/mps/lattice.hpp"

namespace surge::mps {
namespace {

using testing::l0;

TEST(Collision, KeepsMomentumAndSetsTheRelativeSpeed) {
  const double e = 0.2;
  std::array<Field, 2> x{Field{0.0, 0.3 * l0, 5.0 * l0}, Field{0.0, 0.2 * l0, 0.0}};
  std::array<Field, 2> v{Field{1.0, -0.5, 0.0}, Field{0.2, 0.1, 0.0}};
  const Displacement<2> displacement(x, {});
  const CollisionModel<2> model(0.5 * l0, e);
  const auto nobody = [](std::size_t) { return false; };
  long count = 0;
  const std::array<std::uint32_t, 2> of_first{1, 2};
  const std::array<std::uint32_t, 2> of_second{0, 2};
  const Vec<2> first = model.velocity_change(0, of_first, displacement, v, nobody, 0.0, count);
  const Vec<2> second = model.velocity_change(1, of_second, displacement, v, nobody, 0.0, count);
  EXPECT_EQ(count, 2);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(first[a] + second[a], 0.0, 1e-15);
  const Vec<2> d = displacement(0, 1);
  const auto normal_speed = [&](double dvx, double dvy) {
    return (dvx * d[0] + dvy * d[1]) / std::sqrt(squared_norm<2>(d));
  };
  const double before = normal_speed(v[0][1] - v[0][0], v[1][1] - v[1][0]);
  const double after = normal_speed(v[0][1] + second[0] - v[0][0] - first[0],
                                    v[1][1] + second[1] - v[1][0] - first[1]);
  EXPECT_NEAR(after, -e * before, 1e-14);
}

TEST(Collision, FixedParticlesTakeUpTheMomentumAndReceedingPairsPass) {
  std::array<Field, 2> x{Field{0.0, 0.4 * l0}, Field{0.0, 0.0}};
  std::array<Field, 2> v{Field{2.0, 0.0}, Field{1.0, 0.0}};
  const Displacement<2> displacement(x, {});
  const CollisionModel<2> model(0.5 * l0, 0.0);
  const auto second_is_wall = [](std::size_t j) { return j == 1; };
  long count = 0;
  const std::array<std::uint32_t, 1> neighbour{1};
  const Vec<2> change =
      model.velocity_change(0, neighbour, displacement, v, second_is_wall, 1.99, count);
  EXPECT_NEAR(change[0], -2.0, 1e-14);
  EXPECT_NEAR(change[1], 0.0, 1e-14);
  const auto speed_after = [&](double least) {
    return model.velocity_change(0, neighbour, displacement, v, second_is_wall, least, count)[0];
  };
  EXPECT_EQ(speed_after(2.01), 0.0);  // too slow an approach
  v[0][0] = -2.0;
  EXPECT_EQ(speed_after(0.0), 0.0);
  EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace surge::mps
