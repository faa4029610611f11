// What the processor can do at best: memory bandwidth and multiply-add rate. The limits that the
// figures of the other benchmarks are compared with.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <array>

#include "particle/core/particles.hpp"
#include "particle/core/simd.hpp"

namespace surge::benchmarks {
namespace {

/// STREAM's triad a = b + s c (McCalpin 1995) on arrays that no cache holds. Counts 24 bytes an
/// element as STREAM does, though the processor may read a line of `a` before it writes it.
void triad(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(0)));
  constexpr std::ptrdiff_t n = 32 * 1024 * 1024;
  Field a(n);
  Field b(n);
  Field c(n);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    a[i] = 0.0;
    b[i] = 1.0;
    c[i] = 2.0;
  }
  double s = 3.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(s);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
    benchmark::ClobberMemory();
  }
  if (a[n / 2] != b[n / 2] + s * c[n / 2]) state.SkipWithError("wrong sum");
  state.counters["bytes/s"] = benchmark::Counter(24.0 * static_cast<double>(n),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

/// Independent chains of double-precision FMA in registers, enough of them to hide the latency.
void multiply_add(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(0));
  constexpr int rounds = 1000000;
  constexpr std::size_t chains = 12;
  double factor = 0.999999;
  double sum = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(factor);
#pragma omp parallel num_threads(threads) reduction(+ : sum)
    {
      const Simd x = factor;
      const Simd y = 1e-6;
      std::array<Simd, chains> value;
      for (std::size_t k = 0; k < chains; ++k) value[k] = static_cast<double>(k);
      for (int round = 0; round < rounds; ++round)
        for (Simd& v : value) v = v * x + y;
      for (const Simd& v : value) sum += stdx::reduce(v);
    }
  }
  benchmark::DoNotOptimize(sum);
  state.counters["flops/s"] =
      benchmark::Counter(2.0 * static_cast<double>(simd_width * chains) * rounds * threads,
                         benchmark::Counter::kIsIterationInvariantRate);
}

void threads(benchmark::internal::Benchmark* b) {
  b->ArgName("threads")->Arg(1);
  if (omp_get_num_procs() > 1) b->Arg(omp_get_num_procs());
  b->UseRealTime()->Unit(benchmark::kMillisecond)->Repetitions(5)->ReportAggregatesOnly(true);
}
BENCHMARK(triad)->Apply(threads);
BENCHMARK(multiply_add)->Apply(threads);

}  // namespace
}  // namespace surge::benchmarks

BENCHMARK_MAIN();
