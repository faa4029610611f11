#pragma once

#include "compare/read/run.hpp"

namespace surge::compare {

/// Opens particle files of any program: recognises how they are laid out, asks for all that neither
/// they nor the options say in one message with what was found, and checks the first frame (see
/// check_first_frame) and that the water falls downwards. Fills run.frames, spacing, physics,
/// method and the notices of what was assumed. Throws surge::Error.
void open_foreign_series(Run& run, const SourceOptions& stated);

}  // namespace surge::compare
