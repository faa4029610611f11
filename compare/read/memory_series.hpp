#pragma once

#include <string>
#include <vector>

#include "compare/read/run.hpp"

namespace surge::compare {

/// A run of frames that are in memory, as if they had been read from the files of a foreign
/// program: checked in the same way. `options` must state spacing and gravity; positions are in the
/// axes that it says. A frame has as many velocities and pressures as particles, or none. Throws
/// surge::Error.
[[nodiscard]] Run open_memory(const std::string& name, std::vector<ParticleFrame> frames,
                              const SourceOptions& options);

}  // namespace surge::compare
