#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "particle/core/clock.hpp"
#include "particle/core/step_report.hpp"
#include "particle/io/computation.hpp"

namespace surge {

/// Where a run went on from a checkpoint.
struct Restart {
  std::string at;     ///< UTC, ISO 8601
  long step = 0;      ///< steps that the checkpoint had
  double time = 0.0;  ///< s, of the flow
  int threads = 1;    ///< from there on
  std::string cpu;
};

/// What a run has done so far; the manifest's counts.
struct RunRecord {
  std::string started;  ///< UTC, ISO 8601
  bool finished = false;
  std::string stopped;  ///< why a run did not finish; empty while it runs and when it did
  int threads = 1;
  double wall_total = 0.0;                        ///< s
  std::array<double, phase_names.size()> wall{};  ///< s per Phase
  double cpu = 0.0;            ///< s of all threads, what the operating system did included
  double output_thread = 0.0;  ///< s that the thread that writes frames worked beside the solver
  long steps = 0;
  long frames = 0;
  double simulated = 0.0;  ///< s
  long fluid_particles = 0;
  long wall_particles = 0;  ///< wall and dummy particles
  long lost_particles = 0;  ///< outside the tank at the end
  long clipped = 0;
  long wall_collisions = 0;
  long particle_collisions = 0;
  long ppe_iterations = 0;          ///< of all steps; the pressure solver
  long ppe_unconverged = 0;         ///< steps whose pressure solver gave up
  double ppe_worst_residual = 0.0;  ///< of these
  double ppe_setup = 0.0;           ///< s in all, preconditioner or factorisation
  double ppe_solve = 0.0;           ///< s in all, the rest of it
  double fastest = 0.0;             ///< m/s, of any particle at any step
  double fastest_at = 0.0;          ///< s
  long nonfinite = 0;               ///< values that were infinite or not a number
  std::vector<Restart> restarts;    ///< those that led to what is there

  /// A step that led to `time` (s).
  void add(const StepReport& report, double time);
};

/// A record as a checkpoint keeps it.
[[nodiscard]] nlohmann::json to_json(const RunRecord& record);
/// The same back. Throws nlohmann::json::exception where it is none.
[[nodiscard]] RunRecord run_record(const nlohmann::json& j);

/// What of a run makes its results doubtful, a line each: a pressure solver that gave up, a
/// particle faster than ten times the reference speed of the flow.
[[nodiscard]] std::vector<std::string> warnings_of(const RunRecord& record, const Case& c);

/// The name of this machine's processor.
[[nodiscard]] std::string cpu_name();

/// The manifest of a run, as the text of manifest.json.
[[nodiscard]] std::string manifest_text(const RunRecord& record, const Computation& computation);

/// The time now, UTC, as in 2010-05-03T12:00:00Z.
[[nodiscard]] std::string utc_now();

}  // namespace surge
