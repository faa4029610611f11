#pragma once

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "particle/io/any_solver.hpp"
#include "tests/benchmark/peak_memory.hpp"
#include "tests/case/solver_fixture.hpp"

namespace surge::benchmarks {

/// The solver of a computation: of a method, or whatever it names as AnySolver<D>.
template <class Solver>
class Made {
 public:
  explicit Made(const Computation& c) : solver_(test::make_solver<Solver>(c)) {}
  Solver& get() { return solver_; }

 private:
  Solver solver_;
};
template <int D>
class Made<AnySolver<D>> {
 public:
  explicit Made(const Computation& c) : solver_(c.make_solver<D>()) {}
  AnySolver<D>& get() { return *solver_; }

 private:
  std::unique_ptr<AnySolver<D>> solver_;
};

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
  explicit Flow(const Computation& c) : made_(c), solver(made_.get()) {
    const double particles = static_cast<double>(solver.particles().size());
    advance(static_cast<int>(std::clamp(3e6 / particles, 5.0, 50.0)));
    bytes_per_particle = memory_.bytes() / particles;
  }
  void advance(int steps) {
    for (int k = 0; k < steps; ++k) report = solver.step(std::numeric_limits<double>::max());
  }

 private:
  PeakMemory memory_;  // first: what the solver allocates counts
  Made<Solver> made_;

 public:
  Solver& solver;
  StepReport report;
  double bytes_per_particle = 0.0;
};

using Clock = std::chrono::steady_clock;

inline double seconds_of(const auto& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Times steps and reports what all methods have in common. Returns particle-steps per second.
/// Before each step on several threads there is one on one thread: the efficiency is the median of
/// t_1 / (threads t_threads) over such pairs, because the speed of a shared machine drifts.
/// Amdahl's serial fraction of a step follows from it, f = (1/efficiency - 1)/(threads - 1), and
/// from that the efficiency at 16 threads, 1/(1 + 15 f); what the threads take of each other's
/// memory bandwidth counts as serial.
template <class Solver>
double time_steps(benchmark::State& state, Flow<Solver>& flow, int threads) {
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

  const auto& p = flow.solver.particles();
  const auto particles = static_cast<double>(p.size());
  const auto fluid =
      static_cast<double>(std::count(p.type.begin(), p.type.end(), ParticleType::fluid));
  const auto steps = static_cast<double>(state.iterations());
  const double rate = particles * steps / spent;
  state.counters["particle_steps/s"] = rate;
  state.counters["fluid_steps/s"] = fluid * steps / spent;
  state.counters["particles"] = particles;
  state.counters["bytes/particle"] = flow.bytes_per_particle;
  if (!efficiencies.empty()) {
    const double efficiency = median_of(efficiencies);
    const double serial = std::max(0.0, (1.0 / efficiency - 1.0) / (threads - 1));
    state.counters["efficiency"] = efficiency;
    state.counters["serial_fraction"] = serial;
    state.counters["efficiency_at_16"] = 1.0 / (1.0 + 15.0 * serial);
  }
  for (std::size_t k = 0; k < phases.size(); ++k) {
    const std::string name = phase_names[static_cast<std::size_t>(phases[k])];
    state.counters[name + "_share"] = phase_seconds[k] / spent;
  }
  return rate;
}

}  // namespace surge::benchmarks
