#pragma once

#include <memory>
#include <vector>

#include "compare/measure/observable.hpp"

namespace surge::compare {

/// Measures all observables in one pass over the frames of a run: each frame is read once, with the
/// union of the fields that are needed of it, and is forgotten before the next one. What was left
/// out of the files goes to run.notices. Findings in the order of the observables; one that fails
/// has its failure in them and does not keep the others from theirs. Throws surge::Error where a
/// frame cannot be read.
[[nodiscard]] std::vector<Findings> measure_all(
    Run& run, const std::vector<std::unique_ptr<Observable>>& observables);

}  // namespace surge::compare
