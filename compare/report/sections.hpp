#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// A part of the report's numbers: `measure` adds them to the metrics, where what metrics() of the
/// comparator has measured is already. How they are shown is the templates' business (page/).
struct Section {
  void (*measure)(const StudyResult& study, nlohmann::json& metrics);
  bool needs_reference = true;  ///< left out of a study that has no reference run
  bool of_the_paper = false;    ///< left out of a study that does not judge a paper's statements
  bool needs_front = false;     ///< left out where no leading edge is measured
};

/// In the order in which they are measured: a later one may read what an earlier one has added.
[[nodiscard]] std::span<const Section> report_sections();

void measure_summary(const StudyResult& study, nlohmann::json& metrics);
/// Adds metrics["answer"]: what stands first on the page. {"quantity": {"key", "measure", "title",
/// "unit", "short"} that the runs are ranked by, or null; "rows": at most five runs and the
/// reference, the last, each with {"run", "label", "short", "E", "U", "tolerance", "verdict",
/// "why", "moment_s", "wall_s", "threads", "alone"}; "more": complete runs besides these;
/// "nearest", "next": numbers of rows; "gap", "gap_U" between the two; "order": "sure", "open" or
/// "unknown"; "moment":
/// {"key", "title"} of moment_s}. Reads what the other sections have added.
void measure_answer(const StudyResult& study, nlohmann::json& metrics);
void measure_figures(const StudyResult& study, nlohmann::json& metrics);
void measure_observables(const StudyResult& study, nlohmann::json& metrics);
void measure_wall_pressure(const StudyResult& study, nlohmann::json& metrics);
void measure_runs(const StudyResult& study, nlohmann::json& metrics);
void measure_claims(const StudyResult& study, nlohmann::json& metrics);
void measure_verification(const StudyResult& study, nlohmann::json& metrics);
void measure_errata(const StudyResult& study, nlohmann::json& metrics);
void measure_deviations(const StudyResult& study, nlohmann::json& metrics);
void measure_provenance(const StudyResult& study, nlohmann::json& metrics);

}  // namespace surge::compare
