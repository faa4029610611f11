// Whole time steps of all presets in two and three dimensions, on the column in the middle of its
// collapse (developed_flow.hpp): what a step of a recommended preset costs beside one of the
// paper's, and one in 3D beside one in 2D. Neighbours are those of the fluid, within the method's
// interaction radius.
//
// And the same beside another busy process, as on anybody's laptop.

#include <benchmark/benchmark.h>
#include <omp.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "particle/io/presets.hpp"
#include "particle/support/passive_waiting.hpp"
#include "tests/benchmark/developed_flow.hpp"
#include "tests/benchmark/timed_flow.hpp"

namespace surge::benchmarks {
namespace {

struct Preset {
  std::string method;
  std::string name;
};

std::vector<Preset> all_presets() {
  std::vector<Preset> all;
  for (const Method& method : methods())
    for (const std::string& name : preset_names(method.name))
      all.push_back({std::string(method.name), name});
  return all;
}

template <int D>
Flow<AnySolver<D>>& flow_of(const Computation& c, std::int64_t fluid) {
  const std::string key = c.method_name() + '-' + c.preset + '/' + std::to_string(fluid);
  return Flow<AnySolver<D>>::get(c, key);
}

template <int D>
void preset_step(benchmark::State& state, const Preset& preset) {
  const Computation c = developed_column<D>(preset.method, preset.name, state.range(0));
  auto& flow = flow_of<D>(c, state.range(0));
  const double rate = time_steps(state, flow, static_cast<int>(state.range(1)));
  const Particles<D>& p = flow.solver.particles();
  const double radius = c.method->interaction_radius(c.options) * c.flow.spacing;
  const double pairs =
      count_pairs<D>(p, radius, [](ParticleType type) { return type == ParticleType::fluid; });
  const auto fluid =
      static_cast<double>(std::count(p.type.begin(), p.type.end(), ParticleType::fluid));
  state.counters["neighbours"] = pairs / fluid;
  state.counters["pairs/s"] = rate * pairs / static_cast<double>(p.size());
}

/// A process that does nothing but keep a core busy, while the object lives.
class BusyNeighbour {
 public:
  BusyNeighbour() : child_(fork()) {
    if (child_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // whatever ends the benchmark ends it too
    for (unsigned k = 0;; ++k) benchmark::DoNotOptimize(k);
  }
  ~BusyNeighbour() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  BusyNeighbour(const BusyNeighbour&) = delete;
  BusyNeighbour& operator=(const BusyNeighbour&) = delete;
  [[nodiscard]] bool there() const { return child_ > 0; }

 private:
  pid_t child_;
};

/// All threads beside a busy process: `threads_over_one` is the median time of a step over that of
/// one thread beside the same process. Threads that spin while they wait for the one that was put
/// aside would make it thirty.
void busy_neighbour(benchmark::State& state, const Preset& preset) {
  const Computation c = developed_column<2>(preset.method, preset.name, state.range(0));
  auto& flow = flow_of<2>(c, state.range(0));
  const BusyNeighbour neighbour;
  if (!neighbour.there()) {
    state.SkipWithError("no other process could be started");
    return;
  }
  const int all = omp_get_num_procs();
  std::vector<double> ratios;
  for (auto _ : state) {
    state.PauseTiming();
    omp_set_num_threads(1);
    const double alone = seconds_of([&] { flow.advance(2); });
    state.ResumeTiming();
    omp_set_num_threads(all);
    ratios.push_back(seconds_of([&] { flow.advance(2); }) / alone);
  }
  state.counters["threads_over_one"] = median_of(ratios);
}

benchmark::internal::Benchmark* usual(benchmark::internal::Benchmark* b) {
  return b->Repetitions(3)->ReportAggregatesOnly(true)->UseRealTime()->Unit(
      benchmark::kMillisecond);
}

template <int D>
void register_steps(const Preset& preset) {
  const int all = omp_get_num_procs();
  const std::string name =
      "preset_step/" + preset.method + '-' + preset.name + '/' + std::to_string(D) + 'D';
  for (const std::int64_t fluid : {10000, 100000, 1000000})
    for (int threads = 1; threads <= all; threads += std::max(1, all - 1))
      usual(benchmark::RegisterBenchmark(
                name.c_str(), [preset](benchmark::State& s) { preset_step<D>(s, preset); })
                ->ArgNames({"fluid", "threads"})
                ->Args({fluid, threads})
                ->Iterations(std::clamp<std::int64_t>(200000 / fluid, 2, 20)));
}

void register_all() {
  for (const Preset& preset : all_presets()) {
    register_steps<2>(preset);
    register_steps<3>(preset);
    const std::string name = "busy_neighbour/" + preset.method + '-' + preset.name;
    usual(benchmark::RegisterBenchmark(name.c_str(),
                                       [preset](benchmark::State& s) { busy_neighbour(s, preset); })
              ->ArgName("fluid")
              ->Arg(2000)
              ->Iterations(50));
  }
}

}  // namespace
}  // namespace surge::benchmarks

int main(int argc, char** argv) {
  surge::wait_passively(argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  surge::benchmarks::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
