#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/study/curve_measures.hpp"
#include "compare/study/study_result.hpp"

namespace surge::compare {

/// One curve of one observable, which all runs may have: a value over time, or a profile at a time.
struct ObservedQuantity {
  std::size_t observable = 0;  ///< index in StudyResult::observables
  std::string key;             ///< "sensor_1", "force-pillar.x", "surface@0.156"
  std::string title;
  std::string unit;             ///< of the value
  std::string component;        ///< "x", "y", "z" or empty
  std::optional<double> asked;  ///< of a profile, s

  [[nodiscard]] bool is_profile() const { return asked.has_value(); }
};

/// All of them, in the study's order: what any measured run of role comparison has.
[[nodiscard]] std::vector<ObservedQuantity> observed_quantities(const StudyResult& study);

/// The curve of a run. Values before the first and after the first gap are left out: a curve is
/// straight between its points and a gap is not known. Empty where the run has none.
struct ObservedCurve {
  Curve curve;
  std::size_t left_out = 0;    ///< points without a value, or after a gap
  std::optional<double> time;  ///< of a profile: that of its frame, s
};
[[nodiscard]] ObservedCurve curve_of(const ObservedQuantity& quantity, const MeasuredRun& run);

/// Series that belong to this quantity, by component and time.
[[nodiscard]] std::vector<const ReferenceSeries*> series_of(const StudyResult& study,
                                                            const ObservedQuantity& quantity);

}  // namespace surge::compare
