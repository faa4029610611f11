#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "particle/io/surface_forces.hpp"
#include "tests/case/solver_fixture.hpp"

namespace surge {
namespace {

/// Still water, H = 0.15 m deep, beside a wedge with a face of 45 degrees: a polygon.
constexpr const char* wedge_case = R"(title = "Still water beside a wedge"
dimension = 2
[fluid]
density = 1000.0
gravity = [0.0, -9.81]
[tank]
lower = [0.0, 0.0]
upper = [0.4, 0.3]
open = ["y+"]
[[block]]
shape = "box"
lower = [0.0, 0.0]
upper = [0.4, 0.15]
[[obstacle]]
polygon = [[0.195, 0.0], [0.4, 0.0], [0.4, 0.205]]
[[force]]
on = "obstacle.0"
[resolution]
spacing = 0.01
[time]
end = 0.2
[output]
interval = 0.1
)";

/// Mean force on the wedge over the second half of the run, N/m.
template <class S>
Point mean_force(const std::string& method, const std::string& preset) {
  const Computation c = parse_computation(
      wedge_case + ("[method]\nname = \"" + method + "\"\npreset = \"" + preset + "\"\n"),
      "wedge.toml", {});
  S solver = test::make_solver<S>(c);
  SurfaceForces<2> forces(c.flow);
  Point mean{};
  double weight = 0.0;
  while (solver.time() < c.flow.time.end) {
    const StepReport report = solver.step(c.flow.time.end - solver.time());
    EXPECT_EQ(report.lost, 0);
    if (solver.time() < 0.5 * c.flow.time.end) continue;
    EXPECT_LT(report.v_max, 0.2);  // sqrt(2 g H) is 1.7 m/s
    const Point f = forces.measure(solver.particles(), solver.time()).front();
    for (std::size_t a = 0; a < 2; ++a) mean[a] += report.dt * f[a];
    weight += report.dt;
  }
  return {mean[0] / weight, mean[1] / weight, 0.0};
}

// Exact: rho g H^2 / 2 to the right and as much down, 110.4 N/m each. With 15 particles over the
// depth it is low by the distance of the particles that the sensors on the face see.
void expect_hydrostatic(const Point& force) {
  const double exact = 0.5 * 1000.0 * 9.81 * 0.15 * 0.15;
  EXPECT_NEAR(force[0] / exact, 1.0, 0.1);
  EXPECT_NEAR(force[1] / exact, -1.0, 0.1);
  EXPECT_NEAR(force[0] + force[1], 0.0, 1e-9 * exact);  // normal to the face
}

TEST(Wedge, HydrostaticForceMps) {
  expect_hydrostatic(mean_force<mps::Solver<2>>("mps", "improved"));
}
TEST(Wedge, HydrostaticForceSph) {
  expect_hydrostatic(mean_force<sph::Solver<2>>("sph", "delta-plus"));
}
TEST(Wedge, HydrostaticForceIsph) {
  expect_hydrostatic(mean_force<isph::Solver<2>>("isph", "shifted"));
}

}  // namespace
}  // namespace surge
