#include "foam_cases/acceleration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "particle/core/body_force.hpp"

namespace surge::foam {
namespace {

constexpr Point gravity{0.0, -9.81, 0.0};

TankMotion rotation(int dimension) {
  TankMotion motion;
  motion.kind = TankMotion::Kind::rotation;
  motion.direction = {0.0, 0.0, 1.0};
  if (dimension == 3) motion.direction = {2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
  motion.centre = {0.3, -0.2, dimension == 3 ? 0.5 : 0.0};
  motion.law.kind = ScalarMotion::Kind::harmonic;
  motion.law.amplitude = 0.4;
  motion.law.period = 1.5;
  motion.law.phase = 0.7;
  return motion;
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// What tabulatedAccelerationSource makes of a row.
Point computed(const AccelerationRow& row, const Point& x, const Point& v) {
  const Point euler = cross(row.alpha, x), coriolis = cross(row.omega, v);
  const Point centripetal = cross(row.omega, cross(row.omega, x));
  Point a;
  for (std::size_t i = 0; i < 3; ++i)
    a[i] = gravity[i] - row.linear[i] - 2.0 * coriolis[i] - centripetal[i] - euler[i];
  return a;
}

/// The body force of the particle methods is the same, at any place and velocity.
template <int D>
void expect_same_as_particles() {
  Case c;
  c.dimension = D;
  c.gravity = gravity;
  c.motion = rotation(D);
  const BodyForce<D> force(c);
  const AccelerationTable table(c.motion, gravity, 2.0, 1e-3);
  const Point x{0.7, 0.4, D == 3 ? -0.6 : 0.0}, v{1.1, -0.3, D == 3 ? 0.8 : 0.0};
  ASSERT_GT(table.rows().size(), 500U);
  EXPECT_GE(table.rows().back().time, 2.0);
  for (std::size_t k = 1; k < table.rows().size(); k += 50) {
    const AccelerationRow& row = table.rows()[k];
    const auto a = force.at(row.time, row.time, row.time);
    const Point found = computed(row, x, v);
    for (std::size_t i = 0; i < D; ++i) {
      double expected = a.uniform[i];
      for (std::size_t j = 0; j < D; ++j)
        expected += a.gradient[i][j] * (x[j] - a.centre[j]) + a.turning[i][j] * v[j];
      EXPECT_NEAR(found[i], expected, 1e-11) << "row " << k << ", axis " << i;
    }
  }
}

TEST(Acceleration, OfATurningTankIsThatOfTheParticlesIn2D) {
  expect_same_as_particles<2>();
}

TEST(Acceleration, OfATurningTankIsThatOfTheParticlesIn3D) {
  expect_same_as_particles<3>();
}

TankMotion translation(ScalarMotion law) {
  TankMotion motion;
  motion.kind = TankMotion::Kind::translation;
  motion.direction = {0.6, 0.8, 0.0};
  motion.law = std::move(law);
  return motion;
}

/// The integral of the table by the trapezoidal rule, along the direction.
double gained(const AccelerationTable& table) {
  double sum = 0.0;
  const auto along = [](const AccelerationRow& row) {
    return 0.6 * row.linear[0] + 0.8 * row.linear[1];
  };
  for (std::size_t k = 1; k < table.rows().size(); ++k)
    sum += 0.5 * (along(table.rows()[k]) + along(table.rows()[k - 1])) *
           (table.rows()[k].time - table.rows()[k - 1].time);
  return sum;
}

TEST(Acceleration, OfATranslationIsItsSecondDerivative) {
  ScalarMotion law;
  law.kind = ScalarMotion::Kind::harmonic;
  law.amplitude = 0.02;
  law.period = 0.8;
  const AccelerationTable table(translation(law), gravity, 1.0, 1e-3);
  EXPECT_EQ(table.jumps(), 0U);
  const double omega = 2.0 * std::numbers::pi / 0.8;
  for (const AccelerationRow& row : table.rows()) {
    EXPECT_NEAR(row.linear[0], -0.6 * 0.02 * omega * omega * std::sin(omega * row.time), 1e-12);
    EXPECT_NEAR(row.linear[1], -0.8 * 0.02 * omega * omega * std::sin(omega * row.time), 1e-12);
    EXPECT_EQ(row.omega, Point{});
  }
}

TEST(Acceleration, JumpsOfTheVelocityKeepTheirImpulse) {
  ScalarMotion law;
  law.kind = ScalarMotion::Kind::constant;
  law.speed = 0.7;
  law.start = 0.2;
  law.stop = 5.0;
  const AccelerationTable table(translation(law), gravity, 1.0, 1e-3);
  EXPECT_EQ(table.jumps(), 1U);
  EXPECT_NEAR(table.jump_time(), 0.01, 1e-12);
  EXPECT_NEAR(gained(table), 0.7, 0.7 * 1e-6);
  // A tank that moves from the start on takes its water along.
  law.start = 0.0;
  EXPECT_EQ(AccelerationTable(translation(law), gravity, 1.0, 1e-3).jumps(), 0U);
}

TEST(Acceleration, TableOfDisplacementsEndsWithTheVelocityOfItsLastStretch) {
  ScalarMotion law;
  law.kind = ScalarMotion::Kind::table;
  law.quantity = ScalarMotion::Quantity::displacement;
  for (int k = 0; k <= 100; ++k) law.samples.push_back({0.02 * k, 0.5 * std::pow(0.02 * k, 2)});
  const AccelerationTable table(translation(law), gravity, 1.0, 1e-3);
  EXPECT_NEAR(table.jump_time(), 0.02, 1e-12);
  // Begun at the mean velocity of the first stretch, 0.01 m/s.
  EXPECT_NEAR(gained(table), 1.0, 0.03);
  EXPECT_NEAR(table.rows()[table.rows().size() / 2].linear[0], 0.6, 1e-9);
}

TEST(Acceleration, TableOfAccelerationsIsTakenAsItIs) {
  ScalarMotion law;
  law.kind = ScalarMotion::Kind::table;
  law.quantity = ScalarMotion::Quantity::acceleration;
  law.samples = {{0.0, 0.0}, {0.1, 2.0}, {0.3, 0.0}, {9.0, 0.0}};
  const AccelerationTable table(translation(law), gravity, 1.0, 1e-3);
  EXPECT_EQ(table.jumps(), 0U);
  EXPECT_NEAR(gained(table), 0.3, 1e-9);
}

}  // namespace
}  // namespace surge::foam
