#pragma once

#include <vector>

#include "compare/figures/gnuplot.hpp"
#include "compare/study/study_result.hpp"

namespace surge::compare {

/// Error over cost of all runs and their levels; none where no run states its cost.
[[nodiscard]] std::vector<Figure> cost_to_error_figures(const StudyResult& study);

}  // namespace surge::compare
