#pragma once

#include <string>
#include <vector>

#include "compare/study/baseline.hpp"

namespace surge::compare {

enum class Status { passed, failed, skipped };
[[nodiscard]] const char* status_text(Status status);

/// One quantity of a baseline held against a source; of a curve, its worst point.
struct Finding {
  std::string quantity;
  Status status = Status::failed;
  std::string worst;  ///< "0.12 s", empty for a single value
  std::string found;  ///< "missing" where the source has none
  std::string expected;
  std::string unit;        ///< empty where there is none
  double deviation = 0.0;  ///< found less expected; not finite where there is no number
  double tolerance = 0.0;
  std::string why;  ///< of a failure that the numbers do not tell
};

/// A curve of the baseline, and what was found in its window.
struct BaselineComparison {
  BaselineCurve expected;
  std::vector<double> at;
  std::vector<double> values;
  std::optional<double> worst;  ///< where it deviates most
};

struct CheckResult {
  std::vector<Finding> findings;
  std::vector<BaselineComparison> curves;

  [[nodiscard]] std::size_t failed() const;
};

/// A source with what its baseline's observables found in it, in their order.
struct ObservedRun {
  Run run;
  std::vector<std::string> observables;
  std::vector<Findings> found;
};
/// Opens nothing: measures all observables in one pass over the frames.
[[nodiscard]] ObservedRun observe(Run run, const FrontOptions& front,
                                  const std::vector<std::string>& observables);

/// The leading edge among them, as far as there is one; empty where it was not asked for.
[[nodiscard]] FrontHistory front_of(const ObservedRun& source);
/// The words that a source is known by: method, preset, dimension, how it was read.
[[nodiscard]] std::map<std::string, std::string> identity_of(const Run& run);
/// A number that goes with the curves: scalar(), and of foreign files `fluid_particles` and
/// `nonfinite` as they were counted.
[[nodiscard]] std::optional<double> held_scalar(const Run& run, const FrontHistory& front,
                                                const std::string& name);

/// Every quantity of the baseline. One that the source lacks, that is not finite, or that has
/// another unit has failed. Where the source's frames are further apart than one and a half times
/// those of the baseline, what lies between them is missing.
[[nodiscard]] CheckResult check(const ObservedRun& source, const Baseline& baseline);

/// How a baseline is made of a source.
struct BlessOptions {
  FrontOptions front;
  std::optional<Seconds> until;  ///< end of the window; else see bless()
  std::string because;           ///< why there
  DimensionlessLength wall_distance{0.1};
  /// Tolerances by the name of an observable or of one of its results; "" for all others.
  std::map<std::string, double> absolute, relative, time;
};

/// A baseline of a source. Its window ends at `until`, else where the leading edge is within
/// `wall_distance` of the far wall, else at the last frame. A curve has 500 points at most, at even
/// distances where the source has more. Without a tolerance the front may be off by 0.02 L, other
/// curves by 0.02 of their largest magnitude. Throws surge::Error for a run that did not finish,
/// where an observable finds nothing, where the window's end is not known, and for a curve of
/// zeros without a tolerance.
[[nodiscard]] Baseline bless(ObservedRun& source, const BlessOptions& options,
                             const Provenance& measured);

}  // namespace surge::compare
