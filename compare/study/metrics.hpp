#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compare/measure/flow_pattern.hpp"
#include "compare/measure/front.hpp"
#include "compare/read/run.hpp"
#include "compare/read/units.hpp"
#include "compare/reference/series.hpp"

namespace surge::compare {

/// Z/L whose arrival times are compared.
inline constexpr std::array<double, 5> arrival_levels{1.5, 2.0, 2.5, 3.0, 3.5};

struct Window {
  DimensionlessTime begin;
  DimensionlessTime end;
};

/// Where a comparison must stop: this far before the far wall.
struct WallRule {
  std::optional<DimensionlessLength> far_wall;  ///< empty: no wall is known
  DimensionlessLength distance{0.1};

  [[nodiscard]] std::optional<DimensionlessLength> limit() const;
};

/// From the first to the last time that both fronts know, cut where either one first comes
/// within the wall's distance. Throws surge::Error where nothing remains.
[[nodiscard]] Window common_window(const DimensionlessFront& a, const DimensionlessFront& b,
                                   const WallRule& wall);

/// d(T) = (Z/L of run) - (Z/L of reference), both linear between their own samples, over a window
/// W. The union of both sample times makes d piecewise linear, so the integrals are exact.
struct FrontDifference {
  Window window;
  double rms = 0.0;      ///< sqrt(1/|W| int d^2 dT)
  double maximum = 0.0;  ///< max |d|
  double bias = 0.0;     ///< 1/|W| int d dT
  DimensionlessTime time_of_maximum;
  /// T of arrival of run minus reference per level; empty where one does not get there in W.
  std::array<std::optional<DimensionlessTime>, arrival_levels.size()> arrival{};
  /// Standard uncertainty of each of them: of both moments between their frames.
  std::array<std::optional<double>, arrival_levels.size()> arrival_uncertainty{};
};
[[nodiscard]] FrontDifference difference(const DimensionlessFront& run,
                                         const DimensionlessFront& reference, const WallRule& wall);

/// A run against published points: d at each point inside the run's own window, run minus series.
struct SeriesDifference {
  std::size_t points = 0;  ///< used; points outside the window are not
  double rms = 0.0;
  double maximum = 0.0;
  double bias = 0.0;
};
struct SeriesComparison {
  SeriesDifference raw;
  /// Added to the series' times (negative: the series is late) where that makes rms smallest,
  /// searched to 0.001 within +-1.
  DimensionlessTime shift;
  SeriesDifference shifted;
};
[[nodiscard]] SeriesComparison against_series(const DimensionlessFront& run,
                                              const PublishedSeries& series, const WallRule& wall);

/// Time at which the front is within half a spacing of the far wall, linear between frames, and
/// the frames before and after it.
using Impact = Moment<Seconds>;
[[nodiscard]] std::optional<Impact> impact(const FrontHistory& history, Metres far_wall,
                                           Metres spacing);

/// A run with all that was measured of it: what metrics, figures and report start from.
struct MeasuredRun {
  Run run;
  FrontHistory history;  ///< empty where no front was asked for
  DimensionlessFront front;
  std::vector<FrontVariant> variants{};  ///< by other choices, where they were asked for
  PatternHistory pattern{};              ///< of runs of role comparison
  std::vector<Findings> observed{};      ///< one per observable of the study
};
[[nodiscard]] MeasuredRun measure(Run run, const FrontOptions& options, bool with_variants = false);

struct MetricsOptions {
  FrontOptions front;
  DimensionlessLength wall_distance{0.1};
  std::set<std::string> allowed_differences;  ///< keys of compare_physics
  bool with_front = true;                     ///< false: the flow has none, or nobody asks for it
};

/// {"front": {<run>: {...}}, "timing": {<run>: {...}}, "published": {...}, "definition": {...}}.
/// Checks physics first. Throws surge::Error.
[[nodiscard]] nlohmann::json metrics(const std::vector<MeasuredRun>& runs,
                                     const std::string& reference,
                                     const std::vector<PublishedSeries>& published,
                                     const MetricsOptions& options);

}  // namespace surge::compare
