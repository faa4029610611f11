#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "particle/io/snapshot.hpp"

namespace surge {

/// Writes frames/frame_NNNNN.vtp (binary, compressed) and, after each, particles.pvd with the
/// frames so far, so that an interrupted run opens in ParaView too. A file appears under its name
/// only when it is complete. Keeps nothing of a snapshot: any thread may call write, one at a time.
class FrameWriter {
 public:
  /// `folder`: the run's; `density_name`: "density" or "number_density"; `times`, s: of the frames
  /// that are there already
  FrameWriter(std::filesystem::path folder, std::string density_name,
              std::vector<double> times = {});

  /// Throws Error where a file cannot be written.
  void write(const Snapshot& snapshot);

 private:
  void write_collection() const;

  std::filesystem::path folder_;
  std::string density_name_;
  std::vector<double> times_;
};

}  // namespace surge
