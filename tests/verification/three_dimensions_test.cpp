#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "compare/verification/exact.hpp"
#include "tests/case/solver_fixture.hpp"
#include "tests/verification/preset.hpp"

// Every recommended preset in three dimensions against exact answers.
namespace surge {
namespace {

class ThreeDimensions : public testing::TestWithParam<MethodPreset> {
 protected:
  /// The particles at the end of a case, given without its method. `each(particles, report)` is
  /// called after every step.
  template <class Each>
  static void run(const std::string& text, double end, const Each& each) {
    const Computation c = parse_computation(text + "[method]\nname = \"" + GetParam().method +
                                                "\"\npreset = \"" + GetParam().name + "\"\n",
                                            "three.toml");
    const auto solver = c.make_solver<3>();
    while (solver->time() < end) {
      const StepReport report = solver->step(end - solver->time());
      ASSERT_EQ(report.lost, 0) << "at t = " << solver->time();
      each(solver->particles(), report);
    }
  }
};

// A sphere of radius 1 m that is stretched along x and pressed together along y and z, not alike:
// all three axes follow an ordinary differential equation. 10 particles over the radius, A t = 0.4.
TEST_P(ThreeDimensions, DropBecomesTheExactEllipsoid) {
  const std::array<double, 3> rates{100.0, -70.0, -30.0};
  constexpr double time = 4e-3;
  std::ostringstream text;
  text << "title = \"Ellipsoid\"\ndimension = 3\n[fluid]\ndensity = 1000.0\ngravity = [0, 0, 0]\n"
          "[[block]]\nshape = \"ball\"\nlower = [-1, -1, -1]\nupper = [1, 1, 1]\n"
          "velocity_gradient = [["
       << rates[0] << ", 0, 0], [0, " << rates[1] << ", 0], [0, 0, " << rates[2]
       << "]]\n[resolution]\nspacing = 0.1\n[time]\nend = 4e-3\ninitial_step = 1e-5\n"
          "maximum_step = 1e-3\n[output]\ninterval = 1e-3\n";
  const auto extents = [](const auto& particles) {
    std::array<double, 3> axes{};
    double n = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      n += 1.0;
      for (std::size_t a = 0; a < 3; ++a) axes[a] += particles.x[a][i] * particles.x[a][i];
    }
    // The mean of x^2 over an ellipsoid is a^2/5; a particle is a cube, which adds l0^2/12.
    for (double& axis : axes) axis = std::sqrt(5.0 * (axis / n + 0.01 / 12.0));
    return axes;
  };
  std::array<double, 3> start{}, end{};
  run(text.str(), time, [&](const auto& particles, const StepReport&) {
    if (start[0] == 0.0) start = extents(particles);
    end = extents(particles);
  });
  const std::array<double, 3> exact = compare::ellipsoid_axes(rates, time);
  for (std::size_t a = 0; a < 3; ++a)
    EXPECT_NEAR(end[a] / exact[a], 1.0, 0.02) << "axis " << a << ", exactly " << exact[a];
  // Far from the sphere that it was, and from what it were without pressure, a_i = 1 + A_i t.
  EXPECT_GT(std::abs(1.0 + rates[1] * time - exact[1]), 0.035);
  for (const double axis : exact) EXPECT_GT(std::abs(axis - 1.0), 0.05);
}

class StillWaterIn3D : public ThreeDimensions {};

// Water at rest, 8 particles deep in a tank of walls: every particle's pressure is rho g depth.
// Gravity points along z, which is no plane flow's axis.
TEST_P(StillWaterIn3D, KeepsItsPressure) {
  const std::string text =
      "title = \"Still water\"\ndimension = 3\n[fluid]\ndensity = 1000.0\n"
      "gravity = [0, 0, -9.81]\n[tank]\nlower = [0, 0, 0]\nupper = [0.12, 0.08, 0.2]\n"
      "open = [\"z+\"]\n[[block]]\nshape = \"box\"\nlower = [0, 0, 0]\nupper = [0.12, 0.08, 0.16]\n"
      "[resolution]\nspacing = 0.02\n[time]\nend = 0.5\n[output]\ninterval = 0.1\n";
  const double scale = 1000.0 * 9.81 * 0.16;
  double squares = 0.0, n = 0.0, fastest = 0.0, time = 0.0;
  run(text, 0.5, [&](const auto& particles, const StepReport& report) {
    time += report.dt;
    if (time < 0.35) return;
    fastest = std::max(fastest, report.v_max);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (particles.type[i] != ParticleType::fluid) continue;
      squares += std::pow(particles.pressure[i] / scale - (1.0 - particles.x[2][i] / 0.16), 2);
      n += 1.0;
    }
  });
  EXPECT_LT(std::sqrt(squares / n), 0.03);
  EXPECT_LT(fastest, 0.1 * std::sqrt(2.0 * 9.81 * 0.16));
}

INSTANTIATE_TEST_SUITE_P(Presets, ThreeDimensions,
                         testing::Values(MethodPreset{"mps", "improved"},
                                         MethodPreset{"sph", "delta-plus"},
                                         MethodPreset{"isph", "shifted"}),
                         [](const auto& preset) { return std::string(preset.param.method); });

INSTANTIATE_TEST_SUITE_P(Presets, StillWaterIn3D,
                         testing::Values(MethodPreset{"mps", "improved"},
                                         MethodPreset{"sph", "delta-plus"},
                                         MethodPreset{"isph", "shifted"}),
                         [](const auto& preset) { return std::string(preset.param.method); });

}  // namespace
}  // namespace surge
