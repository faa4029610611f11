#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// A number behind a verdict.
struct Evidence {
  std::string what;
  nlohmann::json value;  ///< a number, or null where the runs do not give it
};

/// A statement that a publication makes from its results, and what the runs of a study say to it.
struct Claim {
  std::string id;
  std::string statement;
  std::string place;      ///< in the publication
  std::string criterion;  ///< by which the verdict is found, with its thresholds
  /// "reproduced", "not reproduced", "depends on ...", "not measured", or "not decidable": it rests
  /// on a difference that is not larger than its uncertainty, or whose uncertainty is not known
  std::string verdict;
  std::vector<Evidence> evidence;
};

/// Adds metrics["patterns"]: per run the overlap with the reference before and after the impact on
/// the far wall, the water detached from the main body, the smallest distance of particles; and
/// metrics["pattern_levels"], the same of the runs of role convergence, for their uncertainty.
void measure_patterns(const StudyResult& study, nlohmann::json& metrics);

/// Adds metrics["cost"]: per particle run the time spent solving (setup and output left out), per
/// step and per simulated second, and the shares of neighbours, pressure and forces.
void measure_cost(const StudyResult& study, nlohmann::json& metrics);

/// Adds metrics["without_collisions"]: of the MPS runs whose particles do not collide, whatever
/// role they have, the smallest distance of two particles and how far they came.
void measure_runs_without_collisions(const StudyResult& study, nlohmann::json& metrics);

/// All claims of study.study.statements, each by its rule. Needs metrics["front"], ["patterns"],
/// ["without_collisions"], ["cost"] and, for the growth with the number of particles, ["scaling"]
/// where the study has timed runs.
[[nodiscard]] std::vector<Claim> find_claims(const StudyResult& study,
                                             const nlohmann::json& metrics);

}  // namespace surge::compare
