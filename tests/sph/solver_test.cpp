#include <gtest/gtest.h>

#include <omp.h>

#include <cmath>
#include <map>
#include <numbers>

#include "particle/sph/solver.hpp"

namespace surge::sph {
namespace {

/// A case and how it is computed.
struct Flow : Case {
  Params method;
  Search search = Search::cell_grid;
};

template <int D>
Solver<D> solver_of(const Flow& flow) {
  return Solver<D>(flow, flow.method, flow.search);
}

/// A square of fluid at rest far from walls, without gravity, that has been given a velocity field.
Flow free_block(double l0, double shear) {
  Flow c;
  c.gravity = {0.0, 0.0, 0.0};
  FluidBlock block;
  block.box = {{0.0, 0.0, 0.0}, {0.2, 0.2, 0.0}};
  block.velocity = {0.3, -0.1, 0.0};
  block.velocity_gradient[0][1] = shear;
  block.velocity_gradient[1][0] = 0.5 * shear;
  c.blocks = {block};
  c.spacing = l0;
  Params p;
  p.acoustic_courant = 0.25;
  c.method = p;
  return c;
}

Flow small_dam(Search search = Search::cell_grid) {
  Flow c;
  c.has_tank = true;
  c.tank.box = {{0.0, 0.0, 0.0}, {0.4, 0.4, 0.0}};
  c.tank.open[3] = true;
  FluidBlock block;
  block.box = {{0.0, 0.0, 0.0}, {0.1, 0.2, 0.0}};
  c.blocks = {block};
  c.spacing = 0.01;
  c.search = search;
  Params p;
  p.acoustic_courant = 0.25;
  p.negative_pressure = NegativePressure::clip;
  c.method = p;
  return c;
}

template <class S>
std::array<double, 2> momentum(const S& solver) {
  const auto& p = solver.particles();
  std::array<double, 2> sum{};
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t a = 0; a < 2; ++a) sum[a] += solver.particle_mass() * p.v[a][i];
  return sum;
}

/// Positions by id.
template <class S>
std::map<int, std::array<double, 2>> positions(const S& solver) {
  std::map<int, std::array<double, 2>> result;
  const auto& p = solver.particles();
  for (std::size_t i = 0; i < p.size(); ++i) result[p.id[i]] = p.position(i);
  return result;
}

template <class S>
double largest_difference(const S& a, const S& b) {
  const auto x = positions(a);
  const auto y = positions(b);
  double largest = 0.0;
  for (const auto& [id, point] : x)
    for (std::size_t k = 0; k < 2; ++k)
      largest = std::max(largest, std::abs(point[k] - y.at(id)[k]));
  return largest;
}

TEST(SphSolver, ConservesMomentumWithoutWalls) {
  auto solver = solver_of<2>(free_block(0.01, 4.0));
  const auto before = momentum(solver);
  for (int k = 0; k < 100; ++k) solver.step(1.0);
  const auto after = momentum(solver);
  EXPECT_NEAR(after[0], before[0], 1e-11);
  EXPECT_NEAR(after[1], before[1], 1e-11);
  EXPECT_NEAR(before[0], 0.3 * 1000.0 * 0.04, 1e-9) << "the mass is that of the block";
}

TEST(SphSolver, ParticlesStartOnTheLatticeOfTheCase) {
  const auto solver = solver_of<2>(small_dam());
  const auto& p = solver.particles();
  long fluid = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.type[i] != ParticleType::fluid) continue;
    ++fluid;
    EXPECT_NEAR(p.pressure[i], 1000.0 * 9.81 * (0.2 - p.x[1][i]), 1e-6) << "Eq. (26)";
  }
  EXPECT_EQ(fluid, 200);
}

// Second order: halving the step divides the difference to a run with a much shorter step by four.
TEST(SphSolver, LeapFrogIsOfSecondOrder) {
  const auto end = [](double dt) {
    Flow c = free_block(0.02, 3.0);
    // XSPH and a smooth equation of state stay on; clipping and collisions have no order.
    c.time.initial_step = dt;
    auto solver = solver_of<2>(c);
    const long steps = std::lround(0.02 / dt);
    for (long k = 0; k < steps; ++k) solver.step(dt);
    return positions(solver);
  };
  const auto difference = [](const auto& a, const auto& b) {
    double sum = 0.0;
    for (const auto& [id, x] : a)
      for (std::size_t k = 0; k < 2; ++k) sum += std::pow(x[k] - b.at(id)[k], 2);
    return std::sqrt(sum);
  };
  const auto reference = end(3.125e-6);
  const double coarse = difference(end(1e-4), reference);
  const double fine = difference(end(5e-5), reference);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ' ' << fine;
  EXPECT_LT(std::log2(coarse / fine), 2.3);
}

TEST(SphSolver, AllPairsAndCellGridAgree) {
  auto cells = solver_of<2>(small_dam(Search::cell_grid));
  auto pairs = solver_of<2>(small_dam(Search::all_pairs));
  for (int k = 0; k < 30; ++k) {
    cells.step(1.0);
    pairs.step(1.0);
  }
  EXPECT_DOUBLE_EQ(cells.time(), pairs.time());
  // The sums are taken in another order: rounding, grown a little in 30 steps.
  EXPECT_LT(largest_difference(cells, pairs), 1e-12);
}

// Layers that slide over each other change neighbours all the time: lists that were kept too long
// would miss some.
TEST(SphSolver, KeptListsMissNobodyInAShearFlow) {
  Flow c = free_block(0.01, 6.0);
  auto cells = solver_of<2>(c);
  c.search = Search::all_pairs;
  auto pairs = solver_of<2>(c);
  const auto start = positions(cells);
  for (int k = 0; k < 100; ++k) {
    cells.step(1.0);
    pairs.step(1.0);
  }
  double least = 1.0;
  double most = -1.0;
  for (const auto& [id, x] : positions(cells)) {
    least = std::min(least, x[0] - start.at(id)[0]);
    most = std::max(most, x[0] - start.at(id)[0]);
  }
  EXPECT_GT(most - least, 2.0 * c.spacing) << "the lists were made several times";
  EXPECT_LT(largest_difference(cells, pairs), 1e-11);
}

TEST(SphSolver, TheNumberOfThreadsDoesNotMatter) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  auto one = solver_of<2>(small_dam());
  for (int k = 0; k < 50; ++k) one.step(1.0);
  omp_set_num_threads(3);
  auto three = solver_of<2>(small_dam());
  for (int k = 0; k < 50; ++k) three.step(1.0);
  omp_set_num_threads(before);
  EXPECT_EQ(largest_difference(one, three), 0.0);
}

Flow shifted_dam(Search search = Search::cell_grid) {
  Flow c = small_dam(search);
  auto& p = c.method;
  p.shifting = Shifting::concentration;
  p.negative_pressure = NegativePressure::difference;
  return c;
}

TEST(SphSolver, ShiftingIsTheSameForAllSearchesAndThreads) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  auto one = solver_of<2>(shifted_dam());
  auto pairs = solver_of<2>(shifted_dam(Search::all_pairs));
  for (int k = 0; k < 30; ++k) {
    one.step(1.0);
    pairs.step(1.0);
  }
  omp_set_num_threads(3);
  auto three = solver_of<2>(shifted_dam());
  for (int k = 0; k < 30; ++k) three.step(1.0);
  omp_set_num_threads(before);
  EXPECT_EQ(largest_difference(one, three), 0.0);
  EXPECT_LT(largest_difference(one, pairs), 1e-11);
  auto plain = solver_of<2>(small_dam());
  for (int k = 0; k < 30; ++k) plain.step(1.0);
  EXPECT_GT(largest_difference(one, plain), 1e-6) << "it does something";
}

/// A standing wave of sound, v = v0 sin(k x), in a periodic square of 40 columns at rest otherwise.
Flow standing_sound(double damping) {
  constexpr int columns = 40;
  const double l0 = 1.0 / columns;
  Flow c;
  c.gravity = {0.0, 0.0, 0.0};
  c.reference_speed = 1.0;
  c.has_tank = true;
  c.tank.box = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}};
  c.tank.periodic = {true, true, false};
  for (int k = 0; k < columns; ++k) {
    FluidBlock block;
    block.box = {{k * l0, 0.0, 0.0}, {(k + 1) * l0, 1.0, 0.0}};
    block.velocity = {1e-4 * std::sin(2.0 * std::numbers::pi * (k + 0.5) * l0), 0.0, 0.0};
    c.blocks.push_back(block);
  }
  c.spacing = l0;
  Params p;
  p.kernel = Kernel::wendland_c2;
  p.h_over_l0 = 1.5;
  p.xsph_epsilon = 0.0;
  p.acoustic_courant = 0.1;
  p.acoustic_damping = damping;
  c.method = p;
  return c;
}

// v is v0 sin(k x) exp(-b t) [cos(w t) - b/w sin(w t)] with b = zeta k^2 / 2, w^2 = (c0 k)^2 - b^2.
// The kernel hides about (k h)^2 / 10 of each gradient.
TEST(SphSolver, DampingOfSoundIsThatOfABulkViscosity) {
  for (const double damping : {0.0, 0.5, 1.0}) {
    auto solver = solver_of<2>(standing_sound(damping));
    const double k = 2.0 * std::numbers::pi;
    const double b = 0.5 * damping * solver.sound_speed() * solver.smoothing_length() * k * k;
    const double w = std::sqrt(std::pow(solver.sound_speed() * k, 2) - b * b);
    const double period = 2.0 * std::numbers::pi / w;
    for (const double end : {0.5 * period, period}) {
      while (solver.time() < end) solver.step(end - solver.time());
      const auto& p = solver.particles();
      double amplitude = 0.0;
      for (std::size_t i = 0; i < p.size(); ++i)
        amplitude += 2.0 / 1600.0 * p.v[0][i] * std::sin(k * p.x[0][i]);
      const double exact = std::exp(-b * end) * (std::cos(w * end) - b / w * std::sin(w * end));
      EXPECT_NEAR(amplitude / 1e-4, exact, 0.02) << damping << ' ' << end / period;
    }
  }
}

// nu = 0.02 m2/s is more than alpha c0 h / 8 stands for.
TEST(SphSolver, ArtificialViscosityLeavesAViscousFlowAlone) {
  Flow c = small_dam();
  c.kinematic_viscosity = 0.02;
  c.method.artificial_viscosity = 0.01;
  auto with = solver_of<2>(c);
  c.method.artificial_viscosity = 0.0;
  auto without = solver_of<2>(c);
  for (int k = 0; k < 20; ++k) {
    with.step(1.0);
    without.step(1.0);
  }
  for (int a = 0; a < 2; ++a) EXPECT_EQ(with.particles().v[a], without.particles().v[a]);
}

TEST(SphSolver, RunsInThreeDimensions) {
  Flow c = small_dam();
  c.dimension = 3;
  c.tank.box = {{0.0, 0.0, 0.0}, {0.2, 0.2, 0.06}};
  c.blocks[0].box = {{0.0, 0.0, 0.0}, {0.1, 0.1, 0.06}};
  for (const Shifting shifting : {Shifting::none, Shifting::concentration}) {
    c.method.shifting = shifting;
    auto solver = solver_of<3>(c);
    StepReport report;
    for (int k = 0; k < 40; ++k) report = solver.step(1.0);
    EXPECT_EQ(report.lost, 0);
    EXPECT_GT(report.v_max, 0.01);
    EXPECT_LT(report.v_max, 2.0);
  }
}

TEST(SphSolver, StableStepKeepsBothLimits) {
  Flow c = small_dam();
  auto solver = solver_of<2>(c);
  EXPECT_LE(solver.stable_step(), c.time.initial_step);
  solver.step(1.0);
  const double h = 1.2 * c.spacing;
  EXPECT_LE(solver.stable_step(), 0.25 * h / solver.sound_speed());
  for (int k = 0; k < 50; ++k) {
    const StepReport report = solver.step(1.0);
    EXPECT_LE(report.courant, 0.2 * 1.1);
  }
  c.method.acoustic_damping = 10.0;
  auto damped = solver_of<2>(c);
  damped.step(1.0);
  EXPECT_GT(damped.stable_step(), 0.2 * h / damped.sound_speed()) << "damping does not bind it";
}

}  // namespace
}  // namespace surge::sph
