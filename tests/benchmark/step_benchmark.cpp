// Whole time steps of both methods, preset `paper`, 2D, on the column in the middle of its collapse
// (developed_flow.hpp). Particles count with walls unless a counter says fluid.
//
// What one pair costs, counted by hand in the loops that it names (an addition, a multiplication, a
// maximum, a division or a root is one flop; two per FMA). Change it with the loops.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <vector>

#include "particle/mps/solver.hpp"
#include "particle/sph/solver.hpp"
#include "tests/benchmark/developed_flow.hpp"
#include "tests/benchmark/timed_flow.hpp"

namespace surge::benchmarks {
namespace {

/// sph::DensityPass and MomentumPass, for a pair that is met from either side. Both: x_j - x_i 2,
/// r^2 4, root and division 2, derivative of the quintic spline 18. Density alone: v_j - v_i 2,
/// kernel value from the same brackets 8, XSPH 3, divergence 5, sums 3. Momentum alone: pressure
/// term 3, force 2, sums 2.
constexpr double sph_flops_per_pair = (26 + 2 + 8 + 3 + 5 + 3) + (26 + 3 + 2 + 2);
/// Every field that a loop of sph::Solver::step() reads or writes, once per loop and in 2D; what is
/// read of neighbours stays in the cache. Kicks 96, half drift 64, paths since the sort 64, volumes
/// 17, density pass 72 and packing 80, density 24, drift 80, equation of state 40, momentum 40 and
/// packing 48, speed 16.
constexpr double sph_bytes_per_particle = 641;
/// The pressure equation bounds an MPS step: each iteration reads the matrix (4 + 4 bytes an entry)
/// and passes over about 10 vectors. What a preconditioner reads comes on top and is not counted.
constexpr double bytes_per_entry = 8;
constexpr double bytes_of_vectors = 80;

void sph_step(benchmark::State& state) {
  const Computation c = developed_column<2>("sph", "paper", state.range(0));
  auto& flow = Flow<sph::Solver<2>>::get(c, std::to_string(state.range(0)));
  const double rate = time_steps(state, flow, static_cast<int>(state.range(1)));
  const Particles<2>& p = flow.solver.particles();
  const double radius = 3.0 * c.params<sph::Params>().h_over_l0 * c.flow.spacing;
  const double pairs =
      count_pairs(p, radius, [](ParticleType type) { return type == ParticleType::fluid; });
  const double per_particle = pairs / static_cast<double>(p.size());
  state.counters["pairs/particle"] = per_particle;
  state.counters["pairs/s"] = rate * per_particle;
  state.counters["flops/particle"] = sph_flops_per_pair * per_particle;
  state.counters["bytes_moved/particle"] = sph_bytes_per_particle;
}

void mps_step(benchmark::State& state, mps::PpeSolver solver) {
  Computation c = developed_column<2>("mps", "paper", state.range(0));
  std::any_cast<mps::Params&>(c.options).ppe_solver = solver;
  const std::string key = std::to_string(static_cast<int>(solver)) + '/';
  auto& flow = Flow<mps::Solver<2>>::get(c, key + std::to_string(state.range(0)));
  const double rate = time_steps(state, flow, static_cast<int>(state.range(1)));
  const Particles<2>& p = flow.solver.particles();
  const double radius = c.params<mps::Params>().re_laplacian * c.flow.spacing;
  const double pairs =
      count_pairs(p, radius, [](ParticleType type) { return type != ParticleType::dummy; });
  const double per_particle = pairs / static_cast<double>(p.size());
  const linear::PoissonSystem& system = flow.solver.system();
  state.counters["pairs/particle"] = per_particle;
  state.counters["pairs/s"] = rate * per_particle;
  state.counters["iterations"] = flow.report.ppe_iterations;
  state.counters["unknowns"] = static_cast<double>(system.size());
  state.counters["bytes_moved/particle"] =
      flow.report.ppe_iterations *
      (bytes_per_entry * static_cast<double>(system.value.size()) +
       bytes_of_vectors * static_cast<double>(system.size())) /
      static_cast<double>(p.size());
}

/// As many solvers as threads, each with one thread and a flow of its own, beside each other: what
/// the machine leaves of a thread's speed when all its cores work. Their `efficiency`, in pairs
/// with one of them alone, is the ceiling of what sph_step and mps_step can reach.
template <class Solver>
void copies(benchmark::State& state, const Computation& c) {
  const auto threads = static_cast<std::size_t>(state.range(1));
  omp_set_num_threads(1);
  std::vector<std::unique_ptr<Flow<Solver>>> flows;
  for (std::size_t k = 0; k < threads; ++k) flows.push_back(std::make_unique<Flow<Solver>>(c));
  const auto particles = static_cast<double>(flows.front()->solver.particles().size());
  constexpr int steps = 4;
  double spent = 0.0;
  std::vector<double> efficiencies;
  for (auto _ : state) {
    state.PauseTiming();
    const double alone = seconds_of([&] { flows.front()->advance(steps); });
    state.ResumeTiming();
    const double together = seconds_of([&] {
      std::vector<std::jthread> workers;
      for (auto& flow : flows) {
        workers.emplace_back([&flow] {
          omp_set_num_threads(1);
          flow->advance(steps);
        });
      }
    });
    spent += together;
    efficiencies.push_back(alone / together);
  }
  spent /= static_cast<double>(state.iterations());
  state.counters["particle_steps/s"] = particles * steps * static_cast<double>(threads) / spent;
  state.counters["particles"] = particles * static_cast<double>(threads);
  state.counters["efficiency"] = median_of(efficiencies);
}

void register_copies() {
  const auto add = [](const char* name, auto&& run) {
    benchmark::RegisterBenchmark(name, run)
        ->ArgNames({"fluid", "threads"})
        ->Args({100000, omp_get_num_procs()})
        ->Iterations(4)
        ->Repetitions(3)
        ->ReportAggregatesOnly(true)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("sph_step_copies", [](benchmark::State& s) {
    copies<sph::Solver<2>>(s, developed_column<2>("sph", "paper", s.range(0)));
  });
  add("mps_step_copies", [](benchmark::State& s) {
    Computation c = developed_column<2>("mps", "paper", s.range(0));
    std::any_cast<mps::Params&>(c.options).ppe_solver = mps::PpeSolver::multigrid;
    copies<mps::Solver<2>>(s, c);
  });
}

/// One benchmark per size and number of threads. Three repetitions of about `particle_steps` each,
/// few enough steps that the column is still collapsing.
template <class F>
void register_sizes(const char* name, F&& step, std::int64_t largest, std::int64_t particle_steps) {
  const int all = omp_get_num_procs();
  for (const std::int64_t fluid : {2000, 10000, 100000, 1000000}) {
    if (fluid > largest) continue;
    for (int threads = 1; threads <= all; threads += std::max(1, all - 1)) {
      benchmark::RegisterBenchmark(name, step)
          ->ArgNames({"fluid", "threads"})
          ->Args({fluid, threads})
          ->Iterations(std::clamp<std::int64_t>(particle_steps / fluid, 2, 50))
          ->Repetitions(3)
          ->ReportAggregatesOnly(true)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace
}  // namespace surge::benchmarks

int main(int argc, char** argv) {
  using namespace surge::benchmarks;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  register_sizes("sph_step", sph_step, 1000000, 2000000);
  register_sizes(
      "mps_step_multigrid",
      [](benchmark::State& s) { mps_step(s, surge::mps::PpeSolver::multigrid); }, 1000000, 800000);
  register_sizes(
      "mps_step_iccg", [](benchmark::State& s) { mps_step(s, surge::mps::PpeSolver::iccg); },
      100000, 400000);
  register_copies();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
