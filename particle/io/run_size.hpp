#pragma once

#include <nlohmann/json_fwd.hpp>

#include "particle/core/particle_count.hpp"
#include "particle/io/computation.hpp"
#include "particle/support/toml.hpp"

namespace surge {

/// What a run will take, known before anything is built. Memory, disk and steps are guesses.
struct RunSize {
  ParticleCount particles;
  double frames = 0.0;
  double steps =
      0.0;  ///< of the method's limit at the case's reference speed; a calm flow has fewer
  double first_step = 0.0;  ///< s
  double memory = 0.0;      ///< bytes
  double disk = 0.0;        ///< bytes
};
[[nodiscard]] RunSize run_size(const Computation& computation);

[[nodiscard]] nlohmann::json to_json(const RunSize& size);

/// Bytes that this process may use: of the machine, or of the control group that it runs in.
[[nodiscard]] double available_memory();

/// Throws Error for a run of more particles than are numbered, or of more memory than `available`
/// (bytes).
void check_size(const RunSize& size, const TomlTable& root, double available);

/// "1.5 GB"
[[nodiscard]] std::string bytes_text(double bytes);

}  // namespace surge
