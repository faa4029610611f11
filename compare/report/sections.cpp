#include "compare/report/sections.hpp"

#include <array>

#include "compare/report/claims.hpp"
#include "compare/report/viewer.hpp"
#include "compare/study/cost_curves.hpp"
#include "compare/study/cost_to_error.hpp"
#include "compare/study/sensitivity.hpp"
#include "compare/study/sequences.hpp"
#include "compare/study/verdict.hpp"

namespace surge::compare {

std::span<const Section> report_sections() {
  static constexpr bool anyway = false;
  static constexpr bool of_the_paper = true;
  static constexpr bool front = true;
  static const std::array<Section, 18> sections{{{measure_summary},
                                                 {measure_viewer},
                                                 {measure_figures},
                                                 {measure_observables},
                                                 {measure_patterns},
                                                 {measure_wall_pressure},
                                                 {measure_scaling},
                                                 {measure_verdicts},
                                                 {measure_claims, true, of_the_paper, front},
                                                 {measure_sensitivity, true, false, front},
                                                 {measure_convergence, true, false, front},
                                                 {measure_cost_to_error},
                                                 {measure_verification, anyway},
                                                 {measure_runs},
                                                 {measure_deviations, true, of_the_paper},
                                                 {measure_errata, true, of_the_paper},
                                                 {measure_answer},
                                                 {measure_provenance, anyway}}};
  return sections;
}

}  // namespace surge::compare
