#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/measure/flow_pattern.hpp"
#include "compare/reference/reference_series.hpp"
#include "compare/reference/series.hpp"
#include "compare/study/measure_run.hpp"
#include "compare/study/metrics.hpp"
#include "compare/study/study.hpp"
#include "compare/verification/flows.hpp"

namespace surge::compare {

enum class RunStatus {
  complete,    ///< the manifest says finished
  unfinished,  ///< stopped early: measured as far as it goes, and marked wherever it is shown
  unusable,    ///< there, but it cannot be measured or compared; `note` says why
  missing      ///< no such folder
};
[[nodiscard]] std::string status_text(RunStatus status);

/// One run that the study asks for, whether it exists or not.
struct RunResult {
  StudyRun study;
  std::filesystem::path folder;
  RunStatus status = RunStatus::missing;
  std::string note;         ///< why it is not complete, or what is wrong with its front
  nlohmann::json manifest;  ///< null where there is none
  bool readable = true;     ///< false: nothing of its files is to be believed
  /// Its front, in StudyResult: of complete and unfinished runs, where the role asks for one.
  const MeasuredRun* measured = nullptr;

  /// "MPS paper, l0 = 5 mm", "VOF, 20 cells per L"; the run's name where nothing is known of it.
  [[nodiscard]] std::string label() const;
  /// Time of the last measured front; empty where there is none.
  [[nodiscard]] std::optional<Seconds> last_time() const;
};

/// Everything that figures and report sections are made from.
struct StudyResult {
  Study study;
  std::vector<RunResult> runs;             ///< of role comparison: in the study's order, all
  std::vector<MeasuredRun> measured_runs;  ///< those that could be; the reference is the first
  std::vector<PublishedSeries> published;  ///< of the reference's case
  /// Of another case: compared with nothing, shown nowhere; the metrics say why.
  std::vector<PublishedSeries> published_elsewhere;
  std::vector<StudyObservable> observables;  ///< those of the study, or of its reference's case
  std::vector<ReferenceSeries> references;   ///< of all observables
  bool has_front = true;                     ///< whether the leading edge is measured
  std::vector<RunResult> others;             ///< those of all other roles
  std::vector<MeasuredRun> measured_others;  ///< of the roles sensitivity and convergence
  /// Complete runs of role verification, by group and name.
  std::map<std::pair<std::string, std::string>, FlowResult> flows;

  /// In the study's order, none left out, be they missing or not.
  [[nodiscard]] std::vector<const RunResult*> runs_of(Role role) const;

  [[nodiscard]] FrontOptions front_options() const { return {.strip_height = study.strip_height}; }
  /// Without one there is nothing but exact answers to compare with.
  [[nodiscard]] bool has_reference() const { return !study.reference.empty(); }
  /// Whether the runs are held against the statements of a paper.
  [[nodiscard]] bool judges_paper() const { return !study.claims.empty(); }
  [[nodiscard]] const RunResult& reference() const;
  [[nodiscard]] const MeasuredRun& reference_run() const { return *reference().measured; }
  /// Runs of role comparison that have a front, in the study's order.
  [[nodiscard]] std::vector<const RunResult*> measured() const;
  [[nodiscard]] WallRule wall() const;
  /// When the reference's front is at the far wall; empty where it never is.
  [[nodiscard]] std::optional<Seconds> impact_time() const;
  /// What is measured of a run. Its flow pattern is, where it is compared, and where a
  /// publication's statements need it: of levels for their uncertainty, of particles that do not
  /// collide.
  [[nodiscard]] MeasureRequest request(const RunResult& run,
                                       WaterOfRun* reference_of_pattern) const;
  /// Flow pattern of a measured run.
  [[nodiscard]] const PatternHistory& pattern(const RunResult& run) const {
    return run.measured->pattern;
  }
  /// The series of that name; throws surge::Error where there is none.
  [[nodiscard]] const ReferenceSeries& series(const std::string& name) const;
};

/// Runs that were found to be unusable, by name, and why.
using Faults = std::map<std::string, std::string>;

/// Finds each run's status, and the fronts of those that can be compared with the reference: of
/// the roles comparison, sensitivity (whose runs may have another wall condition) and convergence.
/// Published series are read from `series_folder`. Throws Error where the reference cannot be
/// measured; any other run's failure becomes its status. What is read later, frames for pictures
/// and the like, throws RunFault: `known` then has it, in another call.
[[nodiscard]] StudyResult collect(const Study& study, const std::filesystem::path& runs,
                                  const std::filesystem::path& series_folder,
                                  const Faults& known = {});

}  // namespace surge::compare
