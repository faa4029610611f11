// The parts of an MPS step one by one, on particles that have left the lattice
// (developed_flow.hpp): neighbour lists, number density, assembly of the pressure equation. Its
// solvers have pressure_solver_benchmark. Items are particles, walls among them.

#include <benchmark/benchmark.h>
#include <omp.h>

#include <limits>
#include <map>

#include "particle/mps/free_surface.hpp"
#include "particle/mps/laplacian.hpp"
#include "particle/mps/solver.hpp"
#include "tests/benchmark/developed_flow.hpp"
#include "tests/case/solver_fixture.hpp"

namespace surge::benchmarks {
namespace {

/// Particles, sorted into cells, and their neighbours within the Laplacian's radius.
struct Scene {
  explicit Scene(std::int64_t fluid)
      : setup(developed_column<2>("mps", "paper", fluid)),
        grid(setup.search, periodicity_of<2>(setup.flow)) {
    auto solver = test::make_solver<mps::Solver<2>>(setup);
    for (int k = 0; k < 5; ++k) solver.step(std::numeric_limits<double>::max());
    particles = solver.particles();
    grid.build(particles.x, radius(), 2);
    grid.reorder(particles);
    list_neighbours();
  }
  void list_neighbours() {
    list.build(grid, particles.x, radius(),
               [&](std::size_t i) { return particles.type[i] != ParticleType::dummy; });
  }
  [[nodiscard]] const mps::Params& params() const { return setup.params<mps::Params>(); }
  [[nodiscard]] double radius() const { return params().re_laplacian * setup.flow.spacing; }
  [[nodiscard]] Displacement<2> displacement() const {
    return {particles.x, periodicity_of<2>(setup.flow)};
  }

  static Scene& get(benchmark::State& state) {
    static std::map<std::int64_t, Scene> scenes;
    omp_set_num_threads(static_cast<int>(state.range(1)));
    return scenes.try_emplace(state.range(0), state.range(0)).first->second;
  }

  Computation setup;
  Particles<2> particles;
  CellGrid<2> grid;
  NeighbourList<2> list;
};

void report(benchmark::State& state, const Scene& scene, double pairs) {
  const auto rate = benchmark::Counter::kIsIterationInvariantRate;
  const auto particles = static_cast<double>(scene.particles.size());
  state.counters["particles/s"] = benchmark::Counter(particles, rate);
  state.counters["pairs/s"] = benchmark::Counter(pairs, rate);
}

void neighbours(benchmark::State& state) {
  Scene& scene = Scene::get(state);
  for (auto _ : state) scene.list_neighbours();
  const auto has_list = [](ParticleType type) { return type != ParticleType::dummy; };
  report(state, scene, count_pairs(scene.particles, scene.radius(), has_list));
}

void number_density(benchmark::State& state) {
  Scene& scene = Scene::get(state);
  const Displacement<2> displacement = scene.displacement();
  const double re = scene.params().re_gradient * scene.setup.flow.spacing;
  const auto n = static_cast<std::ptrdiff_t>(scene.particles.size());
  for (auto _ : state) {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (scene.particles.type[i] == ParticleType::dummy) continue;
      scene.particles.density[i] = mps::number_density<2>(i, scene.list.of(i), displacement, re);
    }
  }
  const auto has_density = [](ParticleType type) { return type != ParticleType::dummy; };
  report(state, scene, count_pairs(scene.particles, re, has_density));
}

void ppe_assembly(benchmark::State& state) {
  Scene& scene = Scene::get(state);
  const mps::Params& params = scene.params();
  const double n0 = mps::reference_number_density<2>(params.re_gradient);
  AlignedVector<std::int32_t> unknown(scene.particles.size(), -1);
  std::size_t unknowns = 0;
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    const bool solved = scene.particles.type[i] != ParticleType::dummy &&
                        !mps::on_free_surface(scene.particles.density[i], params.beta, n0);
    if (solved) unknown[i] = static_cast<std::int32_t>(unknowns++);
  }
  const double factor = mps::laplacian_factor<2>(
      mps::reference_number_density<2>(params.re_laplacian),
      mps::laplacian_lambda<2>(params.lambda, params.re_laplacian, scene.setup.flow.spacing));
  mps::PoissonAssembly<2> assembly(scene.radius(), factor, scene.setup.flow.spacing);
  const Displacement<2> displacement = scene.displacement();
  for (auto _ : state)
    assembly.assemble(scene.particles, scene.list, displacement, unknown, unknowns);
  report(state, scene, static_cast<double>(assembly.system().value.size()));
  state.counters["unknowns"] = static_cast<double>(unknowns);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"fluid", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (const std::int64_t fluid : {2000, 10000, 100000, 1000000}) {
    b->Args({fluid, 1});
    if (omp_get_num_procs() > 1) b->Args({fluid, omp_get_num_procs()});
  }
}
BENCHMARK(neighbours)->Apply(sizes);
BENCHMARK(number_density)->Apply(sizes);
BENCHMARK(ppe_assembly)->Apply(sizes);

}  // namespace
}  // namespace surge::benchmarks

BENCHMARK_MAIN();
