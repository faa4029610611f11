#include "particle/io/run.hpp"

#include <omp.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <optional>

#include "particle/io/atomic_file.hpp"
#include "particle/io/checkpoint.hpp"
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

/// A place that holds no checkpoint is left as it is: locking it would make the folder.
const std::filesystem::path& checked_folder(const RunOptions& options) {
  if (options.restart) require_checkpoint(options.folder);
  return options.folder;
}

/// One run: the folder, what is recorded about it, and the time since its start.
class Run {
 public:
  Run(const Computation& computation, const RunOptions& options, std::ostream& out)
      : computation_(computation),
        case_(computation.flow),
        folder_(options.folder),
        lock_(checked_folder(options)),
        terminal_(options.terminal),
        out_(out) {
    omp_set_num_threads(options.threads);
    record_.started = utc_now();
    record_.threads = options.threads;
    if (options.restart) {
      checkpoint_.emplace(folder_, computation_);
      take_up(checkpoint_->record());
    } else {
      claim_run_folder(folder_, manifest_text(record_, computation_), options.force);
      ours_ = true;
      write_file(folder_ / "case.toml", to_toml(computation_));
    }
  }

  template <int D>
  RunEnd compute() {
    try {
      const auto solver = checkpoint_ ? restore<D>() : computation_.make_solver<D>();
      write_file(folder_ / "method.json",
                 method_sheet(computation_.method->name, *solver, case_.spacing).dump() + "\n");
      // All until here is setup: what its parts took by phase would count twice.
      solver->clock() = {};
      record_.wall[static_cast<std::size_t>(Phase::setup)] += seconds_since(start_);
      const RunEnd end = compute<D>(*solver);
      finish(end);
      return end;
    } catch (const RestartError&) {
      throw;  // the folder is as it was
    } catch (const std::exception& error) {
      if (!ours_) throw RestartError(folder_.string() + ": " + error.what());
      record_.stopped = error.what();
      write_manifest();
      throw Error(folder_.string() + ": " + error.what());
    }
  }

 private:
  void take_up(const RunRecord& before) {
    const int threads = record_.threads;
    record_ = before;
    record_.restarts.push_back({utc_now(), before.steps, before.simulated, threads, cpu_name()});
    before_ = record_;
    frames_on_disk_ = before.frames;
  }

  template <int D>
  std::unique_ptr<AnySolver<D>> restore() {
    auto solver = computation_.restore_solver<D>(checkpoint_->state());
    if (solver->time() != record_.simulated)
      checkpoint_->state().refuse("the time of the run's record", "another time");
    check_results(folder_, record_.frames, record_.steps, record_.simulated);
    // From here on the folder is ours to change; each change leaves what the checkpoint needs.
    ours_ = true;
    write_manifest();
    cut_back(folder_, record_.frames, record_.steps);
    checkpoint_.reset();
    out_ << "going on from step " << record_.steps << " at " << number_text(record_.simulated)
         << " s" << std::endl;
    return solver;
  }

  /// Of the frames that are there already, s.
  [[nodiscard]] std::vector<double> times_of_frames() const {
    const FrameTimes times(case_.time.end, case_.output_interval);
    std::vector<double> there;
    for (long k = 0; k < record_.frames; ++k) there.push_back(times[k]);
    return there;
  }

  [[nodiscard]] StepTable step_table() const {
    const std::filesystem::path file = folder_ / "steps.csv";
    if (record_.steps == 0) return StepTable(file, recorded_columns(case_));
    return StepTable(file, record_.steps, record_.simulated);
  }

  template <int D>
  RunEnd compute(AnySolver<D>& solver) {
    record_.fluid_particles = count_fluid<D>(solver.particles());
    record_.wall_particles = static_cast<long>(solver.particles().size()) - record_.fluid_particles;
    const std::string density(computation_.method->density_array);
    RunOutput output{FrameQueue(FrameWriter(folder_, density, times_of_frames())), step_table(),
                     Progress(out_, terminal_, case_.time.end, record_.simulated)};
    std::optional<InterruptGuard> guard;
    RunLoop<AnySolver<D>, D> loop(
        solver, case_, output, record_,
        {[&] { return guard->interrupted(); }, [&] { return checkpoint_is_due(); },
         [&] { keep_checkpoint<D>(solver, output); }});
    try {
      // Until here a signal ends the program at once: there is nothing to keep.
      guard.emplace();
      const RunEnd end = loop.run();
      output.progress.close();
      record_times(solver.clock(), output);
      return end;
    } catch (...) {
      output.progress.close();
      record_what_is_there(output);
      record_times(solver.clock(), output);
      throw;
    }
  }

  [[nodiscard]] bool checkpoint_is_due() const {
    const double interval = case_.checkpoint_interval;
    return interval > 0.0 && seconds_since(last_checkpoint_) >= interval;
  }

  /// One that cannot be written is no reason to end a run: the older one is still there.
  template <int D>
  void keep_checkpoint(AnySolver<D>& solver, RunOutput& output) {
    record_times(solver.clock(), output);
    try {
      bring_to_disk();
      write_checkpoint(folder_, computation_, record_, solver.state());
      kept_step_ = record_.steps;
    } catch (const Error& error) {
      output.progress.close();
      out_ << "warning: no checkpoint: " << error.what() << std::endl;
    }
    last_checkpoint_ = WallClock::now();
  }

  /// What a checkpoint follows is on the disk before it.
  void bring_to_disk() {
    for (; frames_on_disk_ < record_.frames; ++frames_on_disk_)
      sync_to_disk(folder_ / frame_name(frames_on_disk_));
    sync_to_disk(folder_ / "frames");
    sync_to_disk(folder_ / "steps.csv");
  }

  /// Times of all parts of the run until now, whether it came to its end or failed.
  void record_times(const Clock& clock, const RunOutput& output) {
    for (const Phase phase : {Phase::neighbours, Phase::pressure, Phase::forces, Phase::output}) {
      const auto k = static_cast<std::size_t>(phase);
      record_.wall[k] = before_.wall[k] + clock.seconds(phase);
    }
    record_.output_thread = before_.output_thread + output.frames.busy_s();
    record_total_times();
  }

  void record_total_times() {
    record_.wall_total = before_.wall_total + seconds_since(start_);
    record_.cpu = before_.cpu + cpu_seconds() - cpu_start_;
  }

  /// The counts of a run that failed are those of its files.
  void record_what_is_there(RunOutput& output) {
    const auto attempt = [](auto&& write) {
      try {
        write();
      } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch)
        // What failed first is what is told.
      }
    };
    attempt([&] { output.frames.finish(); });
    attempt([&] { output.steps.flush(); });
    record_.frames = before_.frames + output.frames.written();
    record_.steps = output.steps.written();
    record_.simulated = output.steps.written_until();
  }

  void finish(RunEnd end) {
    record_.finished = end == RunEnd::finished;
    if (end == RunEnd::interrupted) record_.stopped = "interrupted";
    write_manifest();
    if (record_.finished) remove_checkpoint(folder_);
    out_ << (record_.finished ? "finished: " : "interrupted: ") << number_text(record_.simulated)
         << " s in " << record_.steps << " steps, " << duration_text(record_.wall_total) << " on "
         << record_.threads << (record_.threads == 1 ? " thread; " : " threads; ") << record_.frames
         << " frames, " << record_.lost_particles
         << " particles lost: " << (folder_ / "particles.pvd").string() << std::endl;
    if (!record_.finished && kept_step_ == record_.steps)
      out_ << "with --restart it goes on from here" << std::endl;
    for (const std::string& warning : warnings_of(record_, case_))
      out_ << "warning: " << warning << std::endl;
  }

  void write_manifest() {
    record_total_times();
    write_file(folder_ / "manifest.json", manifest_text(record_, computation_));
  }

  const Computation& computation_;
  const Case& case_;
  std::filesystem::path folder_;
  FolderLock lock_;
  bool terminal_;
  std::ostream& out_;
  bool ours_ = false;  ///< whether the folder is this run's to write to
  std::optional<Checkpoint> checkpoint_;
  RunRecord record_;
  RunRecord before_;  ///< what was recorded before a restart
  WallClock::time_point start_ = WallClock::now();
  double cpu_start_ = cpu_seconds();
  WallClock::time_point last_checkpoint_ = start_;
  long kept_step_ = -1;
  long frames_on_disk_ = 0;
};

}  // namespace

RunEnd run_case(const Computation& computation, const RunOptions& options, std::ostream& out) {
  Run run(computation, options, out);
  return computation.flow.dimension == 2 ? run.compute<2>() : run.compute<3>();
}

}  // namespace surge
