#include "particle/case/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace surge {
namespace {

using Kind = ScalarMotion::Kind;

/// Velocity and acceleration are the derivatives of the displacement, by central differences.
void expect_consistent(const ScalarMotion& m, double t, double tolerance) {
  const double h = 1e-5;
  const MotionState before = motion_at(m, t - h), here = motion_at(m, t),
                    after = motion_at(m, t + h);
  EXPECT_NEAR(here.velocity, (after.displacement - before.displacement) / (2.0 * h), tolerance)
      << t;
  EXPECT_NEAR(here.acceleration, (after.velocity - before.velocity) / (2.0 * h), tolerance) << t;
}

TEST(Motion, NoneIsAtRest) {
  const MotionState state = motion_at({}, 3.0);
  EXPECT_EQ(state.displacement, 0.0);
  EXPECT_EQ(state.velocity, 0.0);
  EXPECT_EQ(state.acceleration, 0.0);
}

TEST(Motion, HarmonicHasItsAmplitudeAndPeriod) {
  ScalarMotion m;
  m.kind = Kind::harmonic;
  m.amplitude = 0.032;
  m.period = 1.3;
  const double omega = 2.0 * std::numbers::pi / 1.3;
  EXPECT_NEAR(motion_at(m, 0.25 * 1.3).displacement, 0.032, 1e-15);
  EXPECT_NEAR(motion_at(m, 0.25 * 1.3).acceleration, -0.032 * omega * omega, 1e-12);
  EXPECT_NEAR(motion_at(m, 0.0).velocity, 0.032 * omega, 1e-15);
  EXPECT_NEAR(motion_at(m, 2.0).displacement, motion_at(m, 2.0 + 1.3).displacement, 1e-14);
}

TEST(Motion, RampStartsFromRestAndEndsInTheHarmonic) {
  ScalarMotion m;
  m.kind = Kind::harmonic;
  m.amplitude = 0.1;
  m.period = 0.7;
  m.phase = 1.0;
  m.start = 0.5;
  m.ramp = 2.0;
  const MotionState start = motion_at(m, 0.5);
  EXPECT_EQ(start.displacement, 0.0);
  EXPECT_EQ(start.velocity, 0.0);
  EXPECT_EQ(start.acceleration, 0.0);
  EXPECT_EQ(motion_at(m, 0.2).displacement, 0.0);
  for (double t = 0.55; t < 4.0; t += 0.137) expect_consistent(m, t, 1e-6);
  ScalarMotion whole = m;
  whole.ramp = 0.0;
  EXPECT_NEAR(motion_at(m, 3.0).displacement, motion_at(whole, 3.0).displacement, 1e-15);
  EXPECT_NEAR(motion_at(m, 1.5).displacement, 0.5 * motion_at(whole, 1.5).displacement, 1e-15);
}

TEST(Motion, ConstantMovesBetweenStartAndStop) {
  ScalarMotion m;
  m.kind = Kind::constant;
  m.speed = 1.5;
  m.start = 0.1;
  m.stop = 0.3;
  EXPECT_EQ(motion_at(m, 0.05).displacement, 0.0);
  EXPECT_NEAR(motion_at(m, 0.2).displacement, 0.15, 1e-15);
  EXPECT_EQ(motion_at(m, 0.2).velocity, 1.5);
  EXPECT_NEAR(motion_at(m, 9.0).displacement, 0.3, 1e-15);
  EXPECT_EQ(motion_at(m, 9.0).velocity, 0.0);
}

TEST(Motion, TableOfDisplacementsIsLinearBetweenItsSamples) {
  ScalarMotion m;
  m.kind = Kind::table;
  m.samples = {{0.0, 0.0}, {1.0, 2.0}, {3.0, 1.0}};
  EXPECT_NEAR(motion_at(m, 0.25).displacement, 0.5, 1e-15);
  EXPECT_NEAR(motion_at(m, 0.25).velocity, 2.0, 1e-15);
  EXPECT_NEAR(motion_at(m, 2.0).displacement, 1.5, 1e-15);
  EXPECT_NEAR(motion_at(m, 2.0).velocity, -0.5, 1e-15);
  EXPECT_EQ(motion_at(m, 7.0).displacement, 1.0);
  EXPECT_EQ(motion_at(m, 7.0).velocity, 0.0);
}

TEST(Motion, TableOfAccelerationsIsIntegratedExactly) {
  ScalarMotion m;
  m.kind = Kind::table;
  m.quantity = ScalarMotion::Quantity::acceleration;
  m.samples = {{0.0, 0.0}, {2.0, 6.0}};  // a = 3 t
  const MotionState inside = motion_at(m, 1.5);
  EXPECT_NEAR(inside.acceleration, 4.5, 1e-14);
  EXPECT_NEAR(inside.velocity, 1.5 * 1.5 * 1.5, 1e-14);
  EXPECT_NEAR(inside.displacement, 0.5 * 1.5 * 1.5 * 1.5, 1e-14);
  // After the table nothing accelerates.
  const MotionState later = motion_at(m, 3.0);
  EXPECT_EQ(later.acceleration, 0.0);
  EXPECT_NEAR(later.velocity, 6.0, 1e-14);
  EXPECT_NEAR(later.displacement, 4.0 + 6.0, 1e-14);
  m.samples = {{0.0, 1.0}, {0.5, -2.0}, {1.0, 3.0}};
  for (const double t : {0.2, 0.6, 0.9}) expect_consistent(m, t, 1e-5);
}

}  // namespace
}  // namespace surge
