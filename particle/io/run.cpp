#include "particle/io/run.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "particle/case/scales.hpp"
#include "particle/io/interrupt.hpp"
#include "particle/io/method_sheet.hpp"
#include "particle/io/run_folder.hpp"

namespace surge {

namespace {

using WallClock = std::chrono::steady_clock;

double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

/// CPU seconds of this process, all threads together.
double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

template <int D>
long count_fluid(const Particles<D>& particles) {
  return std::count(particles.type.begin(), particles.type.end(), ParticleType::fluid);
}

/// One run: the folder, what is recorded about it, and the time since its start.
class Run {
 public:
  Run(const Computation& computation, const RunOptions& options, std::ostream& out)
      : computation_(computation),
        case_(computation.flow),
        folder_(options.folder),
        lock_(options.folder),
        terminal_(options.terminal),
        out_(out) {
    omp_set_num_threads(options.threads);
    record_.threads = options.threads;
    record_.started = utc_now();
    claim_run_folder(folder_, manifest_text(record_, computation_));
    write_file(folder_ / "case.toml", to_toml(computation_));
  }

  template <int D>
  RunEnd compute() {
    const InterruptGuard guard;
    try {
      const auto made = computation_.make_solver<D>();
      AnySolver<D>& solver = *made;
      write_file(folder_ / "method.json",
                 method_sheet(computation_.method->name, solver, case_.spacing).dump() + "\n");
      // All until here is setup: what its parts took by phase would count twice.
      solver.clock() = {};
      record_.wall[static_cast<std::size_t>(Phase::setup)] = seconds_since(start_);
      const RunEnd end = compute<D>(solver, guard);
      finish(end);
      return end;
    } catch (const std::exception& error) {
      record_.stopped = error.what();
      record_.wall_total = seconds_since(start_);
      write_manifest();
      throw Error(folder_.string() + ": " + error.what());
    }
  }

 private:
  template <int D>
  RunEnd compute(AnySolver<D>& solver, const InterruptGuard& guard) {
    record_.fluid_particles = count_fluid<D>(solver.particles());
    record_.wall_particles = static_cast<long>(solver.particles().size()) - record_.fluid_particles;
    const std::string density(computation_.method->density_array);
    RunOutput output{FrameQueue(FrameWriter(folder_, density)),
                     StepTable(folder_ / "steps.csv", case_.probes),
                     Progress(out_, terminal_, case_.time.end)};
    RunLoop<AnySolver<D>, D> loop(solver, case_, output, record_,
                                  [&] { return guard.interrupted(); });
    try {
      const RunEnd end = loop.run();
      output.progress.close();
      record_phases(solver.clock());
      return end;
    } catch (...) {
      output.progress.close();
      record_phases(solver.clock());
      throw;
    }
  }

  /// What the phases of the steps took, whether the run came to its end or failed.
  void record_phases(const Clock& clock) {
    for (const Phase phase : {Phase::neighbours, Phase::pressure, Phase::forces, Phase::output})
      record_.wall[static_cast<std::size_t>(phase)] = clock.seconds(phase);
  }

  void finish(RunEnd end) {
    record_.finished = end == RunEnd::finished;
    if (end == RunEnd::interrupted) record_.stopped = "interrupted";
    record_.wall_total = seconds_since(start_);
    write_manifest();
    out_ << (record_.finished ? "finished: " : "interrupted: ") << number_text(record_.simulated)
         << " s in " << record_.steps << " steps, " << duration_text(record_.wall_total) << " on "
         << record_.threads << (record_.threads == 1 ? " thread; " : " threads; ") << record_.frames
         << " frames, " << record_.lost_particles
         << " particles lost: " << (folder_ / "particles.pvd").string() << std::endl;
    if (record_.ppe_unconverged > 0) {
      out_ << "warning: the pressure solver gave up in " << record_.ppe_unconverged << " of "
           << record_.steps << " steps, with a residual of up to "
           << number_text(record_.ppe_worst_residual) << " (ppe_tolerance, ppe_max_iterations)"
           << std::endl;
    }
  }

  void write_manifest() {
    record_.cpu = cpu_seconds() - cpu_start_;
    write_file(folder_ / "manifest.json", manifest_text(record_, computation_));
  }

  const Computation& computation_;
  const Case& case_;
  std::filesystem::path folder_;
  FolderLock lock_;
  bool terminal_;
  std::ostream& out_;
  RunRecord record_;
  WallClock::time_point start_ = WallClock::now();
  double cpu_start_ = cpu_seconds();
};

}  // namespace

RunEnd run_case(const Computation& computation, const RunOptions& options, std::ostream& out) {
  Run run(computation, options, out);
  return computation.flow.dimension == 2 ? run.compute<2>() : run.compute<3>();
}

namespace {

template <int D>
CaseSummary summary_of(const Computation& computation) {
  const auto solver = computation.make_solver<D>();
  const long fluid = count_fluid<D>(solver->particles());
  return {fluid, static_cast<long>(solver->particles().size()) - fluid, solver->stable_step()};
}

}  // namespace

CaseSummary summarise(const Computation& computation) {
  return computation.flow.dimension == 2 ? summary_of<2>(computation) : summary_of<3>(computation);
}

double estimated_steps(const Computation& computation) {
  const Case& c = computation.flow;
  const double step = computation.method->step_limit(c, computation.options, reference_speed(c));
  return std::ceil(c.time.end / step);
}

}  // namespace surge
