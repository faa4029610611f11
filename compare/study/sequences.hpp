#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// One level of a sequence: a complete run of role convergence.
struct SequenceLevel {
  const RunResult* run = nullptr;
  double size = 0.0;  ///< spacing, m, or mean time step, s
};

/// The runs of one group of role convergence.
struct Sequence {
  std::string group;
  std::string label;  ///< "MPS paper"
  bool vof = false;
  bool over_spacing = true;           ///< what is refined: the spacing, else the time step
  std::vector<SequenceLevel> levels;  ///< finest first, one thread
  std::vector<SequenceLevel> others;  ///< the same on more threads: they add a cost, no value

  [[nodiscard]] const MeasuredRun& finest() const { return *levels.front().run->measured; }
};

/// In the study's order; groups with no complete run are left out. The sizes are spacings where
/// these differ, else the mean time steps of the runs.
[[nodiscard]] std::vector<Sequence> sequences_of(const StudyResult& study);

/// The finest run of the sequences of VOF over the spacing, what the others are measured
/// against; null where there is none.
[[nodiscard]] const RunResult* finest_vof_run(const std::vector<Sequence>& sequences);

/// T at which Z/L is followed through the levels; the last one is shortly before the far wall.
inline constexpr std::array<double, 4> convergence_times{1.0, 1.5, 2.0, 2.32};

/// Standard uncertainty of a 95 % numerical uncertainty: divided by this. Of the factors in use, 2
/// (errors normal about the computed value) and 1.15 (about the extrapolated one), that which gives
/// the larger uncertainty; see Roache 2009, Fundamentals of Verification and Validation.
inline constexpr double numerical_coverage = 1.15;
/// Published uncertainties are taken as 95 % limits; intervals of differences are given as these
/// many standard uncertainties.
inline constexpr double coverage = 2.0;

/// Standard uncertainty in Z/L of a published point at T: that of its reading, and that of its time
/// times the speed of the front.
[[nodiscard]] double published_uncertainty(const PublishedSeries& series,
                                           const DimensionlessFront& front, DimensionlessTime t);
/// Root of the mean square over the published points that the front covers, shifted in time.
[[nodiscard]] double published_uncertainty_rms(const PublishedSeries& series,
                                               const DimensionlessFront& front,
                                               DimensionlessTime shift);

/// convergence: levels, orders, extrapolated values and indices by sequence and quantity.
void measure_sequences(const StudyResult& study, const std::vector<Sequence>& sequences,
                       nlohmann::json& metrics);
/// uncertainty: E = S - D and u_val = sqrt(u_num^2 + u_input^2 + u_D^2) as in ASME V&V 20-2009, of
/// the particle methods against VOF and of VOF against the experiments. Reads `convergence`.
/// u_input is zero: the computations have the same inputs, and those of the experiments are not
/// stated.
void measure_differences(const StudyResult& study, const std::vector<Sequence>& sequences,
                         nlohmann::json& metrics);
/// Both; empty where no sequence has a complete run.
void measure_convergence(const StudyResult& study, nlohmann::json& metrics);

}  // namespace surge::compare
