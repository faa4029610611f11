#pragma once

#include <filesystem>
#include <ostream>

#include "particle/io/computation.hpp"
#include "particle/io/run_loop.hpp"

namespace surge {

struct RunOptions {
  std::filesystem::path folder;  ///< of the run; made, or taken over from an older run
  int threads = 1;
  bool terminal = false;  ///< whether `out` redraws lines
};

/// Computes a case and writes the folder of the run: manifest.json (at the start with
/// finished = false, and at the end), case.toml (the case with every option written out),
/// steps.csv, particles.pvd and frames. Tells progress and a summary on `out`. Ctrl-C ends the run
/// after the present step. Throws Error; the manifest then says why the run stopped.
RunEnd run_case(const Computation& computation, const RunOptions& options, std::ostream& out);

/// What a solver makes of a case before its first step.
struct CaseSummary {
  long fluid_particles = 0;
  long wall_particles = 0;
  double first_step = 0.0;  ///< s
};
[[nodiscard]] CaseSummary summarise(const Computation& computation);

/// A guess of the number of steps to the end: the method's limit at the case's reference speed. The
/// flow is slower most of the time, so that there are fewer.
[[nodiscard]] double estimated_steps(const Computation& computation);

}  // namespace surge
