#pragma once

#include <vector>

#include "compare/study/study_result.hpp"

namespace surge::compare {

/// Where two bodies of water are, in numbers of wet cells. Both grids must be made from the same
/// physics and cell; overlap() is `both` over all three.
struct WetCells {
  std::size_t both = 0, only_first = 0, only_second = 0;
};
[[nodiscard]] WetCells wet_cells(const FractionGrid& first, const FractionGrid& second);

/// The water of a run beside that of the reference at one time, in the square (cubic) cells of
/// overlap_cell().
struct WaterDifference {
  const RunResult* run = nullptr;
  Seconds time;  ///< one of the study's snapshot times
  Metres cell;
  WetCells cells;  ///< first: the run, second: the reference
  FractionGrid water, reference;

  /// Water where only one of the two has some, m2 or m3.
  [[nodiscard]] double size() const { return size_of(cells.only_first + cells.only_second); }
  /// That over the reference's water; empty where it has none.
  [[nodiscard]] std::optional<double> part() const;
  [[nodiscard]] double size_of(std::size_t count) const;
  int dimension = 2;
};

/// Of a run and a time; empty where one of the two has no frame there.
[[nodiscard]] std::optional<WaterDifference> water_difference(const StudyResult& study,
                                                              const RunResult& run, Seconds time);

}  // namespace surge::compare
