#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <tuple>

#include "particle/io/computation.hpp"
#include "tests/verification/preset.hpp"

// A column at the left wall of a tank and one at the right are the same flow in a mirror: nothing
// in a solver may know left from right: what the pressure solver leaves of the residual is in the
// mirror too, at the tolerance of the presets. What rounding leaves grows with the flow, which is
// chaotic after an impact; an order of particles or cells that has a side would show as a part of a
// spacing within a few steps.
namespace surge {
namespace {

class Mirror : public testing::TestWithParam<std::tuple<MethodPreset, int>> {
 protected:
  static constexpr double l0 = 0.0145;
  /// Of the tank, m.
  [[nodiscard]] static double length() { return (std::get<1>(GetParam()) == 2 ? 40 : 16) * l0; }

  /// A column 10 l0 wide and high at one end of a tank.
  static Computation column(bool right) {
    const auto& [preset, dimension] = GetParam();
    const auto point = [dimension = dimension](double x, double y) {
      std::ostringstream text;
      text.precision(17);
      text << '[' << x << ", " << y << (dimension == 3 ? ", " : "");
      if (dimension == 3) text << (x == 0.0 && y == 0.0 ? 0.0 : 4 * l0);
      text << ']';
      return text.str();
    };
    const auto low = [dimension = dimension](double x) {
      std::ostringstream text;
      text.precision(17);
      text << '[' << x << (dimension == 3 ? ", 0.0, 0.0]" : ", 0.0]");
      return text.str();
    };
    const double begin = right ? length() - 10 * l0 : 0.0;
    std::ostringstream text;
    text.precision(17);
    text << "title = \"column\"\ndimension = " << dimension
         << "\n[fluid]\ndensity = 1000.0\ngravity = [0.0, -9.81" << (dimension == 3 ? ", 0.0" : "")
         << "]\n[tank]\nlower = " << low(0.0)
         << "\nupper = " << point(length(), (std::get<1>(GetParam()) == 2 ? 30 : 12) * l0)
         << "\nopen = [\"y+\"]\n[[block]]\nshape = \"box\"\nlower = " << low(begin)
         << "\nupper = " << point(begin + 10 * l0, 10 * l0) << "\n[resolution]\nspacing = " << l0
         << "\n[time]\nend = 0.1\n[output]\ninterval = 1.0\n[method]\nname = \"" << preset.method
         << "\"\npreset = \"" << preset.name << "\"\n";
    const std::string method = preset.method;
    // Incomplete Cholesky goes through the unknowns from one end to the other.
    if (method == "mps" && std::string(preset.name) == "paper")
      text << "[mps]\nppe_tolerance = 1e-12\n";
    return parse_computation(text.str(), "mirror.toml");
  }

  template <int D>
  static void compare(double end, double reached) {
    const auto left = column(false).make_solver<D>();
    const auto right = column(true).make_solver<D>();
    const auto key = [](const Vec<D>& x, bool mirrored) {
      std::array<long, D> cell;
      for (std::size_t a = 0; a < D; ++a)
        cell[a] = std::lround(2.0 * (a == 0 && mirrored ? length() - x[a] : x[a]) / l0);
      return cell;
    };
    std::map<std::array<long, D>, std::int32_t> at;
    std::map<std::int32_t, std::int32_t> partner;
    for (std::size_t i = 0; i < right->particles().size(); ++i)
      at[key(right->particles().position(i), true)] = right->particles().id[i];
    for (std::size_t i = 0; i < left->particles().size(); ++i)
      partner[left->particles().id[i]] = at.at(key(left->particles().position(i), false));
    while (left->time() < end) {
      const double dt = std::min({left->stable_step(), right->stable_step(), end - left->time()});
      left->step(dt);
      right->step(dt);
    }
    std::map<std::int32_t, std::size_t> index;
    for (std::size_t i = 0; i < right->particles().size(); ++i) index[right->particles().id[i]] = i;
    double furthest = 0.0, largest = 0.0;
    const auto& p = left->particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.type[i] != ParticleType::fluid) continue;
      Vec<D> x = right->particles().position(index.at(partner.at(p.id[i])));
      x[0] = length() - x[0];
      furthest = std::max(furthest, p.x[0][i]);
      for (std::size_t a = 0; a < D; ++a) largest = std::max(largest, std::abs(x[a] - p.x[a][i]));
    }
    EXPECT_GT(furthest, reached);
    EXPECT_LT(largest, 1e-6 * l0);
  }
};

TEST_P(Mirror, LeftAndRightAreAlike) {
  if (std::get<1>(GetParam()) == 2)
    compare<2>(0.12, 11.5 * l0);
  else
    compare<3>(0.04, 9.8 * l0);
}

constexpr MethodPreset mirrored[] = {
    {"mps", "paper"}, {"mps", "improved"}, {"sph", "delta-plus"}, {"isph", "shifted"}};

INSTANTIATE_TEST_SUITE_P(Presets, Mirror,
                         testing::Combine(testing::ValuesIn(mirrored), testing::Values(2, 3)),
                         [](const auto& run) {
                           const MethodPreset& preset = std::get<0>(run.param);
                           std::string name = std::string(preset.method) + "_" + preset.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + "_" + std::to_string(std::get<1>(run.param)) + "D";
                         });

}  // namespace
}  // namespace surge
