// Whole time steps of both methods, preset `paper`, 2D, on the column in the middle of its collapse
// (developed_flow.hpp). Particles count with walls unless a counter says fluid.
//
// What one pair costs, counted by hand in the loops that it names (an addition, a multiplication, a
// maximum, a division or a root is one flop; two per FMA). Change it with the loops.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <thread>
#include <vector>

#include "particle/mps/solver.hpp"
#include "particle/sph/solver.hpp"
#include "tests/benchmark/developed_flow.hpp"
#include "tests/benchmark/peak_memory.hpp"
#include "tests/case/solver_fixture.hpp"

namespace surge::benchmarks {
namespace {

/// sph::Solver::continuity_pass and momentum_pass, for a pair that is met once for both of its
/// particles. Both: x_j - x_i 2, r^2 4, root and division 2, derivative of the quintic spline 18.
/// Continuity alone: v_j - v_i 2, kernel value from the same brackets 8, XSPH 6, divergence 5, sums
/// 6. Momentum alone: pressure term 3, force 2, sums 4.
constexpr double sph_flops_per_pair = (26 + 2 + 8 + 6 + 5 + 6) + (26 + 3 + 2 + 4);
/// Every field that a loop of sph::Solver::step() reads or writes, once per loop and in 2D; what
/// the loops gather for a cell stays in the cache. Kicks 96, half drift 64, volumes 17, continuity
/// 72, density 24, drift 80, equation of state 40, momentum 40, speed 16.
constexpr double sph_bytes_per_particle = 449;
/// The pressure equation bounds an MPS step: each iteration reads the matrix (4 + 4 bytes an entry)
/// and passes over about 10 vectors. What a preconditioner reads comes on top and is not counted.
constexpr double bytes_per_entry = 8;
constexpr double bytes_of_vectors = 80;

/// A solver that has left its first steps behind. One at a time, kept until another one is asked
/// for, so that timings on several thread counts go on from the same state.
template <class Solver>
class Flow {
 public:
  static Flow& get(const Computation& c, const std::string& key) {
    static std::map<std::string, std::unique_ptr<Flow>> flows;
    const auto found = flows.find(key);
    if (found != flows.end()) return *found->second;
    flows.clear();
    return *(flows[key] = std::make_unique<Flow>(c));
  }
  explicit Flow(const Computation& c) : solver(test::make_solver<Solver>(c)) {
    const double particles = static_cast<double>(solver.particles().size());
    advance(static_cast<int>(std::clamp(3e6 / particles, 5.0, 50.0)));
    bytes_per_particle = memory_.bytes() / particles;
  }
  void advance(int steps) {
    for (int k = 0; k < steps; ++k) report = solver.step(std::numeric_limits<double>::max());
  }

 private:
  PeakMemory memory_;  // first: what the solver allocates counts

 public:
  Solver solver;
  StepReport report;
  double bytes_per_particle = 0.0;
};

using Clock = std::chrono::steady_clock;

double seconds_of(const auto& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Times steps and reports what all methods have in common. Returns particle-steps per second.
/// Before each step on several threads there is one on one thread: the efficiency is the median of
/// t_1 / (threads t_threads) over such pairs, because the speed of a shared machine drifts.
template <class Solver>
double time_steps(benchmark::State& state, Flow<Solver>& flow) {
  const auto threads = static_cast<int>(state.range(1));
  const std::array phases{Phase::neighbours, Phase::pressure, Phase::forces};
  std::array<double, phases.size()> phase_seconds{};
  const auto count_phases = [&](double sign) {
    for (std::size_t k = 0; k < phases.size(); ++k)
      phase_seconds[k] += sign * flow.solver.clock().seconds(phases[k]);
  };
  const auto timed_step = [&](int on) {
    omp_set_num_threads(on);
    return seconds_of([&] { flow.advance(1); });
  };
  omp_set_num_threads(threads);
  flow.advance(2);
  double spent = 0.0;
  std::vector<double> efficiencies;
  for (auto _ : state) {
    double alone = 0.0;
    if (threads > 1) {
      state.PauseTiming();
      alone = timed_step(1);
      state.ResumeTiming();
    }
    count_phases(-1.0);
    const double together = timed_step(threads);
    count_phases(1.0);
    spent += together;
    if (threads > 1) efficiencies.push_back(alone / (threads * together));
  }

  const Particles<2>& p = flow.solver.particles();
  const auto particles = static_cast<double>(p.size());
  const auto fluid =
      static_cast<double>(std::count(p.type.begin(), p.type.end(), ParticleType::fluid));
  const auto steps = static_cast<double>(state.iterations());
  const double rate = particles * steps / spent;
  state.counters["particle_steps/s"] = rate;
  state.counters["fluid_steps/s"] = fluid * steps / spent;
  state.counters["particles"] = particles;
  state.counters["bytes/particle"] = flow.bytes_per_particle;
  if (!efficiencies.empty()) state.counters["efficiency"] = median_of(efficiencies);
  for (std::size_t k = 0; k < phases.size(); ++k) {
    const std::string name = phase_names[static_cast<std::size_t>(phases[k])];
    state.counters[name + "_share"] = phase_seconds[k] / spent;
  }
  return rate;
}

void sph_step(benchmark::State& state) {
  const Computation c = developed_column("sph", state.range(0));
  auto& flow = Flow<sph::Solver<2>>::get(c, std::to_string(state.range(0)));
  const double rate = time_steps(state, flow);
  const Particles<2>& p = flow.solver.particles();
  const double radius = 3.0 * c.params<sph::Params>().h_over_l0 * c.flow.spacing;
  const double pairs =
      count_pairs(p, radius, [](ParticleType type) { return type == ParticleType::fluid; });
  const double per_particle = pairs / static_cast<double>(p.size());
  state.counters["pairs/particle"] = per_particle;
  state.counters["pairs/s"] = rate * per_particle;
  state.counters["flops/particle"] = sph_flops_per_pair * 0.5 * per_particle;
  state.counters["bytes_moved/particle"] = sph_bytes_per_particle;
}

void mps_step(benchmark::State& state, mps::PpeSolver solver) {
  Computation c = developed_column("mps", state.range(0));
  std::any_cast<mps::Params&>(c.options).ppe_solver = solver;
  const std::string key = std::to_string(static_cast<int>(solver)) + '/';
  auto& flow = Flow<mps::Solver<2>>::get(c, key + std::to_string(state.range(0)));
  const double rate = time_steps(state, flow);
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
  add("sph_step_copies",
      [](benchmark::State& s) { copies<sph::Solver<2>>(s, developed_column("sph", s.range(0))); });
  add("mps_step_copies", [](benchmark::State& s) {
    Computation c = developed_column("mps", s.range(0));
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
