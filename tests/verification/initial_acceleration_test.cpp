#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "particle/io/computation.hpp"

// The first moment of a collapse has an exact solution, which no front tells as sharply: in a
// column L wide and H high at a wall, lap p = 0, p = 0 on top and at the side, dp/dx = 0 at the
// wall, dp/dy = -rho g on the floor. With k_n = (n + 1/2) pi/L
//   p = rho g sum 2 (-1)^n / (k_n^2 L) cos(k_n x) sinh(k_n (H - y)) / cosh(k_n H).
namespace surge {
namespace {

constexpr double l0 = 0.00725;
constexpr int across = 20;
constexpr double L = across * l0;
constexpr double H = 2.0 * L;

/// m/s2
Vec<2> exact_acceleration(double x, double y) {
  constexpr double g = 9.81;
  Vec<2> a{0.0, -g};
  for (int n = 0; n < 4000; ++n) {
    const double k = (n + 0.5) * std::numbers::pi / L;
    if (k * y > 40.0) break;
    const double share =
        g * (n % 2 == 0 ? 2.0 : -2.0) / (k * L) * std::exp(-k * y) / (1.0 + std::exp(-2.0 * k * H));
    const double below = std::exp(-2.0 * k * (H - y));
    a[0] += share * std::sin(k * x) * (1.0 - below);
    a[1] += share * std::cos(k * x) * (1.0 + below);
  }
  return a;
}

/// Largest error of the acceleration along x, over the exact one, of the column of particles that
/// is `column` from the surface at the side, from `row` to half the height.
double largest_error(const std::string& method, const std::string& preset, int column, int row) {
  const std::string text =
      "title = \"column\"\ndimension = 2\n[fluid]\ndensity = 1000.0\ngravity = [0.0, -9.81]\n"
      "[tank]\nlower = [0.0, 0.0]\nupper = [0.58, 0.58]\nopen = [\"y+\"]\n[[block]]\nshape = "
      "\"box\"\nlower = [0.0, 0.0]\nupper = [0.145, 0.29]\n[resolution]\nspacing = "
      "0.00725\n[time]\n"
      "end = 0.1\ninitial_step = 1e-5\nmaximum_step = 1e-5\n[output]\ninterval = 1.0\n[method]\n"
      "name = \"" +
      method + "\"\npreset = \"" + preset + "\"\n";
  const auto solver = parse_computation(text, "column.toml").make_solver<2>();
  const auto& p = solver->particles();
  const auto speeds = [&] {
    std::vector<double> u(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) u[static_cast<std::size_t>(p.id[i])] = p.v[0][i];
    return u;
  };
  // The pressure in the surface particles follows from step to step, and has to come to rest first.
  for (int k = 0; k < 30; ++k) solver->step(1e-5);
  const std::vector<double> before = speeds();
  const double start = solver->time();
  for (int k = 0; k < 20; ++k) solver->step(1e-5);
  const std::vector<double> after = speeds();
  double largest = 0.0;
  int found = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] != ParticleType::fluid) continue;
    const double x = p.x[0][i];
    const double y = p.x[1][i];
    if (std::lround((L - x) / l0 - 0.5) != column || y < row * l0 || y > 0.5 * H) continue;
    const auto id = static_cast<std::size_t>(p.id[i]);
    const double a = (after[id] - before[id]) / (solver->time() - start);
    const double exact = exact_acceleration(x, y)[0];
    largest = std::max(largest, std::abs(a / exact - 1.0));
    ++found;
  }
  EXPECT_EQ(found, across - row);
  return largest;
}

TEST(InitialAcceleration, OfIncompressibleSphIsThatOfPotentialFlow) {
  EXPECT_LT(largest_error("isph", "shifted", 0, 4), 0.03);
  EXPECT_LT(largest_error("isph", "shifted", 1, 4), 0.02);
  EXPECT_LT(largest_error("isph", "shifted", 5, 4), 0.02);
}

// The outermost particles of `improved` start too fast, the others nearly right.
TEST(InitialAcceleration, OfImprovedMpsIsTooLargeInTheSurfaceAlone) {
  EXPECT_LT(largest_error("mps", "improved", 0, 4), 0.4);
  EXPECT_LT(largest_error("mps", "improved", 1, 4), 0.15);
  EXPECT_LT(largest_error("mps", "improved", 5, 4), 0.03);
}

}  // namespace
}  // namespace surge
