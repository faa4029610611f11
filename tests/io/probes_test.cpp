#include "particle/io/probes.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/case/case_fixture.hpp"

namespace surge {
namespace {

constexpr double l0 = 0.01;

/// Water on the left of a wall at x = 0.12, down to y = 0, on the lattice, with a pressure p(x, y).
template <class F>
Particles<2> lattice(F p, double shift) {
  Particles<2> particles;
  particles.resize(20 * 40);
  for (std::size_t k = 0; k < particles.size(); ++k) {
    particles.x[0][k] = 0.12 - l0 * (0.5 + static_cast<double>(k % 20));
    particles.x[1][k] = l0 * (0.5 + static_cast<double>(k / 20)) - shift;
    particles.type[k] = ParticleType::fluid;
    particles.pressure[k] = p(particles.x[0][k], particles.x[1][k]);
  }
  return particles;
}

double measured(const Particles<2>& particles) {
  const Case c = test::make_case({"probe.0.position=[0.12,0.1]"});
  return Probes<2>(c).measure(particles)[0];
}

TEST(Probes, KeepAConstantPressureAtAWall) {
  EXPECT_NEAR(measured(lattice([](double, double) { return 7.0; }, 0.003)), 7.0, 1e-12);
}

TEST(Probes, HydrostaticPressureAtAWallIsWithinATenthOfASpacing) {
  // Wherever the lattice lies beside the probe at y = 0.1.
  for (double shift = 0.0; shift < l0; shift += 0.1 * l0) {
    const double found = measured(lattice([](double, double y) { return -y; }, shift));
    EXPECT_NEAR(found, -0.1, 0.1 * l0) << shift;
  }
}

TEST(Probes, MeasureHalfASpacingInFrontOfAWall) {
  for (double shift = 0.0; shift < l0; shift += 0.1 * l0) {
    const double away = measured(lattice([](double x, double) { return 0.12 - x; }, shift));
    EXPECT_GT(away, 0.5 * l0) << shift;
    EXPECT_LT(away, 0.65 * l0) << shift;
  }
}

TEST(Probes, FeelNothingWhereThereIsNoWater) {
  EXPECT_EQ(measured(Particles<2>()), 0.0);
}

/// The weight of the half of a disc that lies in front of a wall: int (1 - r/R)^2 dV = pi R^2/12,
/// over l0^2 with R = 2 l0.
constexpr double half_disc = std::numbers::pi / 3.0;

TEST(Probes, FeelADropOnlyWhereItIs) {
  Particles<2> drop;
  drop.resize(1);
  drop.type[0] = ParticleType::fluid;
  drop.x[0][0] = 0.12 - l0;
  drop.x[1][0] = 0.1;
  drop.pressure[0] = 8.0;
  EXPECT_NEAR(measured(drop), 0.25 * 8.0 / (0.75 * half_disc), 0.01);
}

TEST(Probes, FeelWaterThatCoversThemByHalf) {
  Particles<2> water = lattice([](double, double) { return 8.0; }, 0.0);
  for (std::size_t i = 0; i < water.size(); ++i)
    if (water.x[1][i] > 0.1) water.type[i] = ParticleType::dummy;
  EXPECT_NEAR(measured(water), 0.5 * 8.0 / 0.75, 0.2);
}

// p = y^2 over a strip of length d: its mean is y0^2 + d^2/12, and half a spacing of depth more.
TEST(Probes, WithADiameterReadTheMeanOverTheirArea) {
  const Particles<2> water = lattice([](double, double y) { return y * y; }, 0.0);
  const auto read = [&](const std::string& diameter) {
    const Case c =
        test::make_case({"probe.0.position=[0.12,0.06]", "probe.0.diameter=" + diameter});
    return Probes<2>(c).measure(water)[0];
  };
  EXPECT_NEAR(read("0.1") - read("0"), 0.1 * 0.1 / 12.0, 0.05 * 0.1 * 0.1 / 12.0);
}

// A corner of the tank, where a quarter of the disc is open.
TEST(Probes, KeepAConstantPressureInACorner) {
  const Case c = test::make_case({"probe.0.position=[0.0,0.0]"});
  Particles<2> water;
  water.resize(16);
  for (std::size_t k = 0; k < water.size(); ++k) {
    water.x[0][k] = l0 * (0.5 + static_cast<double>(k % 4));
    water.x[1][k] = l0 * (0.5 + static_cast<double>(k / 4));
    water.type[k] = ParticleType::fluid;
    water.pressure[k] = 7.0;
  }
  EXPECT_NEAR(Probes<2>(c).measure(water)[0], 7.0, 1e-12);
}

}  // namespace
}  // namespace surge
