#pragma once

#include <filesystem>
#include <ostream>

#include "particle/io/computation.hpp"
#include "particle/io/run_loop.hpp"

namespace surge {

struct RunOptions {
  std::filesystem::path folder;  ///< of the run; made where it is missing
  int threads = 1;
  bool terminal = false;  ///< whether `out` redraws lines
  bool restart = false;   ///< goes on from the folder's checkpoint
  bool force = false;     ///< replaces the run that the folder holds
};

/// Computes a case and writes the folder of the run: manifest.json (at the start with
/// finished = false, and at the end), case.toml (the case with every option written out),
/// steps.csv, particles.pvd and frames, and while it is not finished checkpoint.bin. Tells progress
/// and a summary on `out`. Ctrl-C and SIGTERM end the run after the present step, with a
/// checkpoint; before the first step they end the program at once. Throws Error; the manifest then
/// says why the run stopped, except for a RestartError, which leaves the folder as it was.
RunEnd run_case(const Computation& computation, const RunOptions& options, std::ostream& out);

}  // namespace surge
