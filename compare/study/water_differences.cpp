#include "compare/study/water_differences.hpp"

#include <algorithm>
#include <cmath>

namespace surge::compare {

WetCells wet_cells(const FractionGrid& first, const FractionGrid& second) {
  WetCells found;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    if (first.wet(i) && second.wet(i))
      ++found.both;
    else if (first.wet(i))
      ++found.only_first;
    else if (second.wet(i))
      ++found.only_second;
  }
  return found;
}

double WaterDifference::size_of(std::size_t count) const {
  return static_cast<double>(count) * std::pow(cell.value(), dimension);
}

std::optional<double> WaterDifference::part() const {
  const std::size_t theirs = cells.both + cells.only_second;
  if (theirs == 0) return std::nullopt;
  return static_cast<double>(cells.only_first + cells.only_second) / static_cast<double>(theirs);
}

std::optional<WaterDifference> water_difference(const StudyResult& study, const RunResult& run,
                                                Seconds time) {
  const Run& own = run.measured->run;
  const Run& other = study.reference_run().run;
  if (own.physics.dimension != other.physics.dimension) return std::nullopt;
  const auto mine = frame_near(own.frames->times(), time);
  const auto theirs = frame_near(other.frames->times(), time);
  if (!mine || !theirs) return std::nullopt;
  // Both in the cells of the reference's tank, as the overlap is measured.
  const Metres cell = overlap_cell(own, other);
  const FractionGrid none(other.physics, cell);
  WaterDifference found{&run, time, cell, {}, none, none, own.physics.dimension};
  const auto fill = [&](FractionGrid& grid, const Run& from, std::size_t index) {
    FrameView view(from.physics, from.spacing);
    view.show(from.frames->read(index, {}));
    grid.add(view);
  };
  fill(found.water, own, *mine);
  fill(found.reference, other, *theirs);
  found.cells = wet_cells(found.water, found.reference);
  return found;
}

}  // namespace surge::compare
