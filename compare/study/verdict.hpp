#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// What can be said of a difference E between a run and what it is held against, when a difference
/// up to a tolerance is of no account.
///
/// ASME V&V 20-2009, Standard for Verification and Validation in Computational Fluid Dynamics and
/// Heat Transfer: the error of the model lies in E - U to E + U, U = k u_val, with
///   u_val = sqrt(u_run^2 + u_reference^2 + u_data^2 + u_frames^2)
/// of independent standard uncertainties, and k = 2 for about 95 %.
enum class Outcome {
  agrees,    ///< all of |E| - U to |E| + U is within the tolerance
  differs,   ///< all of it is beyond the tolerance
  undecided  ///< a part of u_val is not known, or the tolerance lies within the interval
};
[[nodiscard]] std::string outcome_text(Outcome outcome);

/// Standard uncertainties, in the unit of E; empty where one is not known.
struct Uncertainties {
  std::optional<double> run;        ///< of the run, by refining it (Celik et al. 2008)
  std::optional<double> reference;  ///< of the reference, likewise; zero against published data
  std::optional<double> data;       ///< of published data; zero against a run
  std::optional<double> frames;     ///< because a front is known at its frames only
  /// Root of the sum of squares; empty where a part is.
  [[nodiscard]] std::optional<double> combined() const;
};

struct Verdict {
  std::string run;
  std::string quantity;  ///< "leading_edge": RMS of Z/L over the window; "impact": T
  std::string against;   ///< the reference's name, or a published series'
  double difference = 0.0;
  double tolerance = 0.0;
  Uncertainties parts;
  Outcome outcome = Outcome::undecided;
  std::string why;  ///< of what is undecided: what is not known, or what U is mostly made of

  [[nodiscard]] std::optional<double> interval() const;  ///< U
  /// The outcome by decide(). `unknown`: why there is none; empty where all parts are known.
  void settle(const std::string& unknown);
};

/// The rule above.
[[nodiscard]] Outcome decide(double difference, double tolerance, std::optional<double> interval);

/// 95 % numerical uncertainty of a value at one of its levels of refinement: that of the finest
/// level by grid_convergence(), and for a coarser one its distance from the finest besides. Empty
/// where no three levels are systematic. `own`: an index of `levels`.
struct LevelValue {
  double size = 0.0;  ///< spacing, m
  double value = 0.0;
};
[[nodiscard]] std::optional<double> level_uncertainty(const std::vector<LevelValue>& levels,
                                                      std::size_t own);

/// The moments (or places) at which an uncertainty is followed through a window: the middles of
/// eight equal parts.
[[nodiscard]] std::array<double, 8> followed_moments(double begin, double end);

/// Complete runs that are the given one at other spacings, and itself: the same program, case,
/// method, preset and settings but for the resolution and the end; or, where it has a group, the
/// runs of role convergence of that group. One run for each spacing.
[[nodiscard]] std::vector<const RunResult*> refinements_of(const StudyResult& study,
                                                           const RunResult& run);

/// Why a number of a run has no numerical uncertainty.
[[nodiscard]] std::string why_no_uncertainty(const StudyResult& study, const RunResult& run);

/// Standard uncertainty of a run's leading edge, in Z/L: root of the mean square, over
/// eight moments of the window in which it is compared with the reference, of what its refinements
/// say. Empty where they do not say it at all moments that the run's front knows.
[[nodiscard]] std::optional<double> front_uncertainty(const StudyResult& study,
                                                      const RunResult& run);

/// Tolerances of the differences that are judged: of the leading edge in Z/L, a third of the
/// uncertainty with which the experiments can be read and one cell of 20 per L; of the impact in T.
inline constexpr double front_tolerance = 0.05;
inline constexpr double impact_tolerance = 0.05;

/// The verdicts on all measured runs of role comparison: the leading edge and the impact against
/// the reference, the leading edge against each experiment.
[[nodiscard]] std::vector<Verdict> find_verdicts(const StudyResult& study);

/// Adds metrics["verdicts"]: {"coverage", "front_tolerance", "impact_tolerance", "runs": {run:
/// {quantity: {against: {"E", "U", "u_val", "u_run", "u_reference", "u_data", "u_frames",
/// "tolerance", "verdict", "why"}}}}}.
void measure_verdicts(const StudyResult& study, nlohmann::json& metrics);

}  // namespace surge::compare
