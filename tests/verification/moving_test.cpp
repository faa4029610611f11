#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <tuple>

#include "particle/io/computation.hpp"
#include "tests/verification/preset.hpp"

// Tanks and walls that move, against exact answers: every preset, in two and three dimensions.
namespace surge {
namespace {

std::string dimensional(int dimension, double x, double y, double z) {
  std::ostringstream text;
  text << '[' << x << ", " << y;
  if (dimension == 3) text << ", " << z;
  text << ']';
  return text.str();
}

/// What a case is put together from.
class MovingFlow : public testing::TestWithParam<std::tuple<MethodPreset, int>> {
 protected:
  [[nodiscard]] int dimension() const { return std::get<1>(GetParam()); }
  [[nodiscard]] std::string point(double x, double y, double z = 0.0) const {
    return dimensional(dimension(), x, y, z);
  }
  [[nodiscard]] std::string head(double g, double spacing, double end, double speed = 1.5) const {
    std::ostringstream text;
    text << "title = \"moving\"\ndimension = " << dimension() << "\n[fluid]\ndensity = 1000.0\n"
         << "kinematic_viscosity = 0.0\nreference_speed = " << speed
         << "\ngravity = " << point(0.0, -g) << "\n[resolution]\nspacing = " << spacing
         << "\n[time]\nend = " << end << "\n[output]\ninterval = 1.0\n[method]\nname = \""
         << preset().method << "\"\npreset = \"" << preset().name << "\"\n";
    // Eq. (8) as printed is meant for the plane.
    if (dimension() == 3 && std::string(preset().method) == "mps" &&
        std::string(preset().name) == "paper")
      text << "[mps]\nlambda = \"lattice\"\n";
    return text.str();
  }
  /// m
  [[nodiscard]] double spacing() const { return dimension() == 2 ? 0.01 : 0.02; }
  [[nodiscard]] static MethodPreset preset() { return std::get<0>(GetParam()); }
  /// Depth of a three-dimensional case, periodic, so that it is the plane flow.
  double width = 0.16;
  [[nodiscard]] std::string tank(double x, double y, const std::string& more) const {
    return "[tank]\nlower = " + point(0.0, 0.0) + "\nupper = " + point(x, y, width) + "\n" + more +
           (dimension() == 3 ? "periodic = [\"z\"]\n" : "");
  }
  [[nodiscard]] std::string block(double x0, double y0, double x1, double y1,
                                  const std::string& more = "") const {
    return "[[block]]\nshape = \"box\"\nlower = " + point(x0, y0) +
           "\nupper = " + point(x1, y1, width) + "\n" + more;
  }

  /// Calls check(solver, report) after every step up to `end`.
  template <class Check>
  void run(const std::string& text, double end, Check&& check) const {
    const Computation c = parse_computation(text, "moving.toml");
    const auto go = [&](auto solver) {
      while (solver->time() < end) {
        const StepReport report = solver->step(end - solver->time());
        ASSERT_EQ(report.lost, 0) << "at t = " << solver->time();
        check(*solver, report);
      }
    };
    if (dimension() == 2)
      go(c.make_solver<2>());
    else
      go(c.make_solver<3>());
  }
};

struct Fluid {
  double n = 0.0;
  std::array<double, 2> mean{};      ///< m
  std::array<double, 2> velocity{};  ///< m/s
  double rightmost = -1e9;
  double leftmost = 1e9;
};

template <class Solver>
Fluid fluid_of(const Solver& solver) {
  Fluid f;
  const auto& p = solver.particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] != ParticleType::fluid) continue;
    f.n += 1.0;
    for (std::size_t a = 0; a < 2; ++a) f.mean[a] += p.x[a][i], f.velocity[a] += p.v[a][i];
    f.rightmost = std::max(f.rightmost, p.x[0][i]);
    f.leftmost = std::min(f.leftmost, p.x[0][i]);
  }
  for (std::size_t a = 0; a < 2; ++a) f.mean[a] /= f.n, f.velocity[a] /= f.n;
  return f;
}

// A block in the air of a tank that sways falls straight down as seen from outside.
TEST_P(MovingFlow, WhatTouchesNothingDoesNotFeelTheTank) {
  const std::string text = head(9.81, spacing(), 0.06) + tank(0.6, 0.6, "") +
                           block(0.2, 0.3, 0.3, 0.4) +
                           "[motion]\nkind = \"translation\"\ndirection = " + point(1.0, 0.0) +
                           "\nlaw = \"harmonic\"\namplitude = 0.05\nperiod = 0.2\n";
  double t = 0.0;
  Fluid end;
  run(text, 0.06, [&](const auto& solver, const StepReport&) {
    t = solver.time();
    end = fluid_of(solver);
  });
  // At the start the tank has the speed A omega already, and the water, at rest in it, as well.
  const double omega = 2.0 * std::numbers::pi / 0.2;
  const double x = 0.05 * omega * t - 0.05 * std::sin(omega * t);
  // The paper moves with the new velocity: first order in the step.
  EXPECT_NEAR(end.mean[0] - 0.25, x, 0.03 * x);
  EXPECT_NEAR(end.mean[1] - 0.35, -0.5 * 9.81 * t * t, 0.03 * 0.5 * 9.81 * t * t);
}

// A tank that rises at the acceleration a is one that stands under the gravity g + a.
TEST_P(MovingFlow, WaterInALiftIsHeavier) {
  const std::string text =
      head(9.81, spacing(), 0.5) + tank(0.1, 0.2, "open = [\"y+\"]\n") + block(0.0, 0.0, 0.1, 0.1) +
      "[motion]\nkind = \"translation\"\ndirection = " + point(0.0, 1.0) +
      "\nlaw = \"table\"\nquantity = \"acceleration\"\nsamples = [[0.0, 5.0], [1.0, 5.0]]\n";
  double pressure = 0.0;
  double head_sum = 0.0;
  run(text, 0.5, [&](const auto& solver, const StepReport& report) {
    if (solver.time() < 0.25) return;
    const auto& p = solver.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.type[i] != ParticleType::fluid) continue;
      pressure += report.dt * p.pressure[i];
      head_sum += report.dt * 1000.0 * (9.81 + 5.0) * (0.1 - p.x[1][i]);
    }
  });
  EXPECT_NEAR(pressure / head_sum, 1.0, 0.1);
}

// Seen from a tank that turns steadily, a block of water at rest outside turns the other way, by
// the forces of Coriolis and the centrifuge alone.
TEST_P(MovingFlow, WhatRestsOutsideTurnsTheOtherWay) {
  const double omega = 4.0;
  std::ostringstream more;
  more << "velocity = " << point(0.0, omega * -0.05) << "\nvelocity_gradient = "
       << (dimension() == 2 ? "[[0.0, 4.0], [-4.0, 0.0]]"
                            : "[[0.0, 4.0, 0.0], [-4.0, 0.0, 0.0], [0.0, 0.0, 0.0]]")
       << "\n";
  // The block's centre is 0.05 m from the axis.
  std::string text = head(0.0, spacing(), 0.2) + tank(0.6, 0.6, "") +
                     block(0.3, 0.25, 0.4, 0.35, more.str()) +
                     "[motion]\nkind = \"rotation\"\ncentre = " + point(0.3, 0.3) +
                     "\nlaw = \"constant\"\nspeed = 4.0\nstop = 10.0\n" +
                     (dimension() == 3 ? "direction = [0.0, 0.0, 1.0]\n" : "");
  double t = 0.0;
  Fluid end;
  run(text, 0.2, [&](const auto& solver, const StepReport&) {
    t = solver.time();
    end = fluid_of(solver);
  });
  EXPECT_NEAR(end.mean[0] - 0.3, 0.05 * std::cos(omega * t), 5e-4);
  EXPECT_NEAR(end.mean[1] - 0.3, -0.05 * std::sin(omega * t), 5e-4);
}

// A piston that pushes a plug of water along a smooth channel at the acceleration a: all of it
// moves like a solid body, and p = rho a (front - x). The sound that a sudden start makes in SPH
// swings the velocity by a times the length over the speed of sound.
TEST_P(MovingFlow, PistonPushesAPlug) {
  width = 0.08;
  const double a = 20.0;
  const std::string text =
      head(0.0, 0.01, 0.03, 5.0) + tank(0.7, 0.1, "") + block(0.1, 0.0, 0.3, 0.1) +
      "[[moving_wall]]\nname = \"piston\"\nlower = " + point(0.0, 0.0) +
      "\nupper = " + point(0.1, 0.1, width) + "\ndirection = " + point(1.0, 0.0) +
      "\nlaw = \"table\"\nquantity = \"acceleration\"\nsamples = [[0.0, 20.0], [1.0, 20.0]]\n";
  Fluid end;
  double t = 0.0;
  double impulse = 0.0;
  double exact = 0.0;
  run(text, 0.03, [&](const auto& solver, const StepReport& report) {
    t = solver.time();
    end = fluid_of(solver);
    const auto& p = solver.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.type[i] != ParticleType::fluid) continue;
      impulse += report.dt * p.pressure[i];
      exact += report.dt * 1000.0 * a * (0.3 + 0.5 * a * t * t - p.x[0][i]);
    }
  });
  // Where water slides along a wall under so strong a gradient, the wall's pressures are uneven.
  // Water that felt the wall's acceleration a step late only would be late by a seventh.
  const double share = std::string(preset().name) == "paper" ? 0.15 : 0.1;
  EXPECT_NEAR(end.mean[0] - 0.2, 0.5 * a * t * t, share * 0.5 * a * t * t);
  EXPECT_NEAR(end.velocity[0], a * t, share * a * t);
  EXPECT_GT(end.leftmost, 0.1 + 0.5 * a * t * t);
  EXPECT_NEAR(impulse / exact, 1.0, 0.25);
}

// A piston that makes a basin shorter raises its water: volume is kept.
TEST_P(MovingFlow, PistonRaisesTheWater) {
  const std::string text =
      head(9.81, spacing(), 0.6) + tank(0.5, 0.6, "open = [\"y+\"]\n") + block(0.1, 0.0, 0.5, 0.1) +
      "[[moving_wall]]\nname = \"piston\"\nlower = " + point(0.0, 0.0) +
      "\nupper = " + point(0.1, 0.6, width) + "\ndirection = " + point(1.0, 0.0) +
      "\nlaw = \"constant\"\nspeed = 0.25\nstop = 0.4\n";
  double height = 0.0;
  double steps = 0.0;
  run(text, 0.6, [&](const auto& solver, const StepReport&) {
    if (solver.time() < 0.4) return;
    const Fluid now = fluid_of(solver);
    height += now.mean[1];
    EXPECT_GT(now.leftmost, 0.2);
    steps += 1.0;
  });
  // 0.4 m become 0.3 m; the waves that run to and fro lift the mean by a little more, and so does
  // the spray that the coarse projection throws up.
  EXPECT_NEAR(height / steps, 0.05 * 0.4 / 0.3, 0.2 * 0.05 * 0.4 / 0.3);
}

// Behind a gate nothing happens until it is lifted, then the water runs out under it.
TEST_P(MovingFlow, GateHoldsUntilItIsLifted) {
  const std::string text =
      head(9.81, spacing(), 0.3) + tank(0.5, 0.4, "open = [\"y+\"]\n") + block(0.0, 0.0, 0.1, 0.1) +
      "[[moving_wall]]\nname = \"gate\"\nlower = " + point(0.1, 0.0) +
      "\nupper = " + point(0.2, 0.3, width) + "\ndirection = " + point(0.0, 1.0) +
      "\nlaw = \"constant\"\nspeed = 1.5\nstart = 0.1\nstop = 0.25\n";
  Fluid end;
  double before = 0.0;
  run(text, 0.3, [&](const auto& solver, const StepReport&) {
    end = fluid_of(solver);
    if (solver.time() < 0.1) before = std::max(before, end.rightmost);
  });
  EXPECT_LT(before, 0.1);
  EXPECT_GT(end.rightmost, 0.22);
}

constexpr MethodPreset presets[] = {{"mps", "paper"},
                                    {"mps", "improved"},
                                    {"sph", "paper"},
                                    {"sph", "delta-plus"},
                                    {"isph", "shifted"}};

std::string name_of_run(const testing::TestParamInfo<std::tuple<MethodPreset, int>>& run) {
  const MethodPreset& preset = std::get<0>(run.param);
  std::string name = std::string(preset.method) + "_" + preset.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name + "_" + std::to_string(std::get<1>(run.param)) + "D";
}

INSTANTIATE_TEST_SUITE_P(Presets, MovingFlow,
                         testing::Combine(testing::ValuesIn(presets), testing::Values(2, 3)),
                         name_of_run);

}  // namespace
}  // namespace surge
