#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "particle/case/case.hpp"
#include "particle/core/initial_particles.hpp"
#include "particle/core/solver.hpp"
#include "particle/io/frame_queue.hpp"
#include "particle/io/manifest.hpp"
#include "particle/io/probes.hpp"
#include "particle/io/progress.hpp"
#include "particle/io/step_table.hpp"
#include "particle/io/surface_forces.hpp"
#include "particle/support/count.hpp"
#include "particle/support/error.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// Where the results of a run go while it runs.
struct RunOutput {
  FrameQueue frames;
  StepTable steps;
  Progress progress;
};

enum class RunEnd { finished, interrupted };

/// What a run is asked after each step.
struct RunControl {
  std::function<bool()> stop;                                   ///< whether to end it early
  std::function<bool()> checkpoint_due = [] { return false; };  ///< a stop keeps one in any case
  /// Keeps the state of the solver. All results of the steps so far have been handed to the disk.
  std::function<void()> keep_checkpoint = [] {};
};

/// The times of frames: multiples of the interval, and the end.
class FrameTimes {
 public:
  FrameTimes(double end, double interval)
      : end_(end),
        interval_(interval),
        last_(whole_number(std::max(std::ceil(end / interval - 1e-9), 1.0), "output.interval")) {}
  [[nodiscard]] long last() const { return last_; }
  [[nodiscard]] double operator[](long k) const {
    return k >= last_ ? end_ : static_cast<double>(k) * interval_;
  }

 private:
  double end_;
  double interval_;
  long last_;
};

/// The step (s) to ask for when `remaining` is left to the next frame: one that is less than two
/// stable steps away is reached by halves, so that no tiny step is left over.
[[nodiscard]] inline double step_limit(double stable, double remaining) {
  if (remaining <= stable) return remaining;
  return remaining < 2.0 * stable ? 0.5 * remaining : stable;
}

/// Takes a solver from its present state to the end of the case. Steps land on the frames' times. A
/// record that has frames is that of a run which goes on: they are written, the solver stands after
/// the last of them.
template <ParticleSolver S, int D>
class RunLoop {
 public:
  RunLoop(S& solver, const Case& c, RunOutput& output, RunRecord& record, RunControl control)
      : solver_(solver),
        case_(c),
        times_(c.time.end, c.output_interval),
        output_(output),
        record_(record),
        control_(std::move(control)),
        fastest_(100.0 * reference_speed(c)),
        probes_(c),
        forces_(c) {
    if (record.frames == 0) return;
    last_frame_ = times_[record.frames - 1];
    good_ = snapshot(solver_.time());
  }

  /// Throws Error where values cease to be finite, the time step vanishes or a particle is a
  /// hundred times as fast as the reference speed of the flow, or where a frame cannot be written;
  /// what was computed until then is in the output. All frames are on the disk when it returns.
  RunEnd run() {
    const RunEnd end = compute_frames();
    finish_frames();
    if (record_.steps == 0 && end == RunEnd::finished) {
      throw Error("time.end: found " + number_text(case_.time.end) +
                  " s, in which no step is taken, expected more than a billionth of a step of " +
                  number_text(solver_.stable_step()) + " s");
    }
    return end;
  }

 private:
  RunEnd compute_frames() {
    for (long k = record_.frames; k <= times_.last(); ++k) {
      if (advance_to(times_[k]) == RunEnd::interrupted) {
        write_frame(solver_.time());
        return RunEnd::interrupted;
      }
      write_frame(times_[k]);
    }
    return RunEnd::finished;
  }

  RunEnd advance_to(double frame_time) {
    while (true) {
      const double remaining = frame_time - solver_.time();
      const double stable = solver_.stable_step();
      if (remaining <= 1e-9 * stable) return RunEnd::finished;
      take_step(step_limit(stable, remaining));
      const bool stop = control_.stop();
      if (stop || control_.checkpoint_due()) keep_checkpoint();
      if (stop) return RunEnd::interrupted;
    }
  }

  void take_step(double limit) {
    const StepReport report = step(limit);
    record_.add(report, solver_.time());
    record_.simulated = solver_.time();
    check_finite(report);
    const auto scope = solver_.clock().measure(Phase::output);
    record_instruments();
    output_.steps.add(solver_.time(), report, recorded_);
    if (record_.steps % steps_between_copies == 0) good_ = snapshot(solver_.time());
    output_.progress.update(record_.steps, solver_.time());
  }

  void record_instruments() {
    recorded_ = probes_.measure(solver_.particles());
    if (case_.forces.empty()) return;
    for (const Point& force : forces_.measure(solver_.particles(), solver_.time()))
      recorded_.insert(recorded_.end(), force.begin(), force.begin() + D);
  }

  void keep_checkpoint() {
    finish_frames();
    const auto scope = solver_.clock().measure(Phase::output);
    output_.steps.flush();
    control_.keep_checkpoint();
  }

  /// A step that cannot be taken to its end leaves no state to look at.
  StepReport step(double limit) {
    try {
      return solver_.step(limit);
    } catch (const Error& error) {
      throw Error(this_step(record_.steps + 1) + error.what() + keep_last_good());
    }
  }

  [[nodiscard]] std::string this_step(long number) const {
    return "step " + std::to_string(number) + " at t = " + number_text(solver_.time()) + " s: ";
  }

  /// Writes what is known to be right, and says what that is.
  std::string keep_last_good() {
    if (good_.size() > 0 && good_.time > last_frame_) push_frame(std::move(good_));
    finish_frames();
    output_.steps.flush();
    return "; the last good state is frame " + std::to_string(record_.frames - 1) + " at " +
           number_text(last_frame_) + " s";
  }

  void check_finite(const StepReport& report) {
    record_.nonfinite = static_cast<long>(count_nonfinite(solver_.particles()));
    const bool vanished = !(report.dt > 1e-12 * case_.time.maximum_step);
    const bool runaway = fastest_ > 0.0 && report.v_max > fastest_;
    if (record_.nonfinite == 0 && !vanished && !runaway) return;
    const std::string where = keep_last_good();
    const std::string when = this_step(record_.steps) + "found ";
    if (record_.nonfinite > 0) {
      throw Error(when + std::to_string(record_.nonfinite) +
                  " infinite or undefined particle values, expected none" + where);
    }
    if (runaway) {
      throw Error(when + "a particle at " + number_text(report.v_max) + " m/s, expected at most " +
                  number_text(fastest_) + " m/s, a hundred times the reference speed" + where);
    }
    throw Error(when + "a time step of " + number_text(report.dt) + " s, expected more" + where);
  }

  [[nodiscard]] Snapshot snapshot(double time) const {
    return take_snapshot<D>(solver_.particles(), time);
  }

  void write_frame(double time) {
    const auto scope = solver_.clock().measure(Phase::output);
    push_frame(snapshot(time));
  }

  void push_frame(Snapshot frame) {
    last_frame_ = frame.time;
    output_.frames.push(std::move(frame));
    output_.steps.flush();
    ++record_.frames;
  }

  void finish_frames() {
    const auto scope = solver_.clock().measure(Phase::output);
    output_.frames.finish();
  }

  /// The last good state that a failed run shows is at most so many steps old: copying it every
  /// time would cost more than the check itself.
  static constexpr long steps_between_copies = 16;

  S& solver_;
  const Case& case_;
  FrameTimes times_;
  RunOutput& output_;
  RunRecord& record_;
  RunControl control_;
  /// m/s; what is faster is no flow, and would go on for ages in tiny steps. 0: not known
  double fastest_;
  Probes<D> probes_;
  SurfaceForces<D> forces_;
  std::vector<double> recorded_;  ///< recorded_columns() of this step
  Snapshot good_;
  double last_frame_ = 0.0;
};

}  // namespace surge
