#pragma once

#include <vector>

#include "compare/figures/gnuplot.hpp"
#include "compare/study/study_result.hpp"

namespace surge::compare {

/// Where a run has water and the reference has none, and the reverse: a panel for each run and each
/// of the study's snapshot times; none in 3D.
[[nodiscard]] std::vector<Figure> difference_figures(const StudyResult& study);

}  // namespace surge::compare
