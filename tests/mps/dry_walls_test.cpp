#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "particle/io/computation.hpp"
#include "tests/case/solver_fixture.hpp"
#include "tests/places.hpp"

namespace surge::mps {
namespace {

/// A column of water in a tank most of whose walls are dry, 2D or 3D, with the preset `improved`.
template <int D>
Solver<D> collapsing_column(const std::string& search) {
  const std::string name = D == 2 ? "dam_break.toml" : "square_column_3d.toml";
  const Computation c = read_computation(
      tests::sources() + "/particle/cases/" + name,
      std::vector<std::string>{"method.name=mps", "method.preset=improved",
                               "resolution.spacing=" + std::string(D == 2 ? "0.0145" : "0.0145"),
                               "search.neighbours=" + search});
  return test::make_solver<Solver<D>>(c);
}

/// A field by the particles' ids.
template <int D>
Field by_id(const Particles<D>& p, const Field& field) {
  Field out(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) out[static_cast<std::size_t>(p.id[i])] = field[i];
  return out;
}

/// Walls that no water is near have no neighbours listed, where the search over all pairs lists
/// everybody's: nothing in the flow, nor the number density that frames show, may depend on that.
template <int D>
void expect_the_same_as_with_all_pairs(int steps) {
  Solver<D> fast = collapsing_column<D>("cell_grid");
  Solver<D> full = collapsing_column<D>("all_pairs");
  for (int k = 0; k < steps; ++k) {
    const StepReport report = full.step(1.0);
    ASSERT_NEAR(fast.step(1.0).dt, report.dt, 1e-9 * report.dt) << "step " << k;
  }
  const Field density = by_id(fast.particles(), fast.particles().density);
  const Field expected = by_id(full.particles(), full.particles().density);
  double furthest = 0.0;
  for (std::size_t i = 0; i < density.size(); ++i)
    furthest = std::max(furthest, std::abs(density[i] - expected[i]));
  EXPECT_LT(furthest, 1e-6 * fast.reference_density());
  for (int a = 0; a < D; ++a) {
    const Field x = by_id(fast.particles(), fast.particles().x[a]);
    const Field exact = by_id(full.particles(), full.particles().x[a]);
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], exact[i], 1e-9);
  }
}

TEST(DryWalls, DoNotMatterInAPlaneFlow) {
  expect_the_same_as_with_all_pairs<2>(60);
}

TEST(DryWalls, DoNotMatterInThreeDimensions) {
  expect_the_same_as_with_all_pairs<3>(15);
}

// The wall's own neighbours are there before any water comes.
TEST(DryWalls, HaveTheirNumberDensityFromTheStart) {
  Solver<2> solver = collapsing_column<2>("cell_grid");
  solver.step(1.0);
  const Particles<2>& p = solver.particles();
  long dry = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] != ParticleType::wall) continue;
    EXPECT_GT(p.density[i], 0.3 * solver.reference_density());
    dry += p.x[1][i] > 0.5 ? 1 : 0;
  }
  EXPECT_GT(dry, 100);
}

}  // namespace
}  // namespace surge::mps
