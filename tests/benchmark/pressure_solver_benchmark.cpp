// Seconds, iterations and time per unknown of each pressure solver on a jittered column of water,
// twice as high as wide, from a zero guess to 1e-6. The product with A comes first: it is the unit
// in which iterative solvers on different machines can be compared. Where the library is there, its
// multigrid stands beside ours; ours stays while it wins.

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <random>

#include "particle/linear/pressure_solver.hpp"
#include "tests/linear/poisson_fixture.hpp"
#ifdef SURGE_BOOMER_AMG
#include "tests/benchmark/boomer_amg.hpp"
#endif

namespace surge::linear {
namespace {

const PoissonSystem& column_of(std::int64_t unknowns) {
  static std::map<std::int64_t, PoissonSystem> systems;
  const auto [found, is_new] = systems.try_emplace(unknowns);
  if (is_new) {
    const auto width = static_cast<int>(std::sqrt(static_cast<double>(unknowns) / 2.0));
    PoissonSystem& system = found->second;
    system = testing::LatticeSystem({.counts = {width, 2 * width + 1, 1}, .jitter = 0.2}).system;
    std::mt19937 random(5);
    std::normal_distribution<double> normal(1.0, 3.0);
    system.rhs.resize(system.size());
    for (double& value : system.rhs) value = normal(random);
  }
  return found->second;
}

void count_unknowns(benchmark::State& state, std::size_t unknowns) {
  state.counters["unknowns"] = static_cast<double>(unknowns);
  state.counters["s/unknown"] = benchmark::Counter(
      static_cast<double>(unknowns),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void product(benchmark::State& state) {
  const PoissonSystem& system = column_of(state.range(0));
  const Field x(system.size(), 1.0);
  Field y;
  for (auto _ : state) {
    multiply(system, x, y);
    benchmark::DoNotOptimize(y.data());
  }
  count_unknowns(state, system.size());
}

void solve(benchmark::State& state, Solver method) {
  const PoissonSystem& system = column_of(state.range(0));
  Params params;
  params.solver = method;
  SolveReport report;
  for (auto _ : state) {
    state.PauseTiming();
    PressureSolver solver(params);  // as if the graph had changed: no factorisation is kept
    state.ResumeTiming();
    Field p;
    report = solver.solve(system, p);
    if (!report.converged) state.SkipWithError("not converged");
  }
  count_unknowns(state, system.size());
  state.counters["iterations"] = report.iterations;
  state.counters["residual"] = report.residual;
}

#ifdef SURGE_BOOMER_AMG
void solve_by_boomer_amg(benchmark::State& state) {
  const PoissonSystem& system = column_of(state.range(0));
  benchmarks::BoomerAmg solver(system);
  benchmarks::BoomerAmg::Report report;
  for (auto _ : state) {
    report = solver.solve(Params().tolerance);
    if (report.residual > 1.01 * Params().tolerance) state.SkipWithError("not converged");
  }
  count_unknowns(state, system.size());
  state.counters["iterations"] = report.iterations;
  state.counters["residual"] = report.residual;
}
#endif

constexpr std::int64_t smallest = 2000;
constexpr std::int64_t middle = 10000;
constexpr std::int64_t large = 100000;
constexpr std::int64_t largest = 1000000;

BENCHMARK(product)->Arg(smallest)->Arg(middle)->Arg(large)->Arg(largest)->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, multigrid, Solver::multigrid)
    ->Arg(smallest)
    ->Arg(middle)
    ->Arg(large)
    ->Arg(largest)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
#ifdef SURGE_BOOMER_AMG
BENCHMARK(solve_by_boomer_amg)
    ->Name("solve/boomer_amg")
    ->Arg(smallest)
    ->Arg(middle)
    ->Arg(large)
    ->Arg(largest)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
#endif
BENCHMARK_CAPTURE(solve, iccg, Solver::iccg)
    ->Arg(smallest)
    ->Arg(middle)
    ->Arg(large)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, cholmod, Solver::cholmod)
    ->Arg(smallest)
    ->Arg(middle)
    ->Arg(large)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace surge::linear

BENCHMARK_MAIN();
