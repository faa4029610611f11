#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/study/observed_curves.hpp"
#include "compare/study/verdict.hpp"

namespace surge::compare {

/// One measure of a run's curve against another curve.
struct Comparison {
  CurveMeasure measure = CurveMeasure::rms;
  std::string unit;
  std::optional<double> run, reference;  ///< of either curve; rms has none
  std::optional<double> maximum, bias;   ///< rms: largest difference, mean of it
  std::optional<std::size_t> points;     ///< rms: published points that were used
  std::optional<double> unshifted;       ///< the difference at the series' own times, if shifted
  std::optional<Verdict> verdict;        ///< empty where there is no difference; `why` says it
  std::string why;
};

/// A run's curve against the reference run or a series.
struct CurveComparison {
  std::string against;  ///< name of the run or series
  std::string label;
  std::string skipped;            ///< why it is not compared; empty where it is
  std::string note;               ///< what else is to be known
  double begin = 0.0, end = 0.0;  ///< window, s or m
  double shift = 0.0;             ///< s, added to the series' times
  std::vector<Comparison> measures;
};

/// Of one quantity and one run: against the reference run, if it is another one, and against every
/// series of the observable.
[[nodiscard]] std::vector<CurveComparison> compare_curve(const StudyResult& study,
                                                         const ObservedQuantity& quantity,
                                                         const RunResult& run);

/// Standard numerical uncertainty of a run's curve at a place, from its refinements; empty where
/// there are no three levels.
[[nodiscard]] std::optional<double> curve_uncertainty(const StudyResult& study,
                                                      const ObservedQuantity& quantity,
                                                      const RunResult& run, double at);

/// Where tolerances come from that a study does not state, see docs/studies.md.
inline constexpr double usual_tolerance = 0.05;

}  // namespace surge::compare
