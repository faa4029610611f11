#include "foam_cases/divisions.hpp"

#include <algorithm>
#include <cmath>

#include "particle/case/divisions.hpp"
#include "particle/support/bounds.hpp"

namespace surge::foam {

namespace {

constexpr long most_tries = 100000;  // which takes milliseconds

bool divides_all(const std::vector<double>& lengths, double cell) {
  return std::all_of(lengths.begin(), lengths.end(),
                     [&](double length) { return whole_cells(length, cell).has_value(); });
}

}  // namespace

std::optional<double> whole_cells(double length, double cell) {
  return whole_spacings(length, cell);
}

NearCells near_cells(const std::vector<double>& lengths, double per, long cells) {
  NearCells near;
  for (long n = cells - 1; n >= std::max(1L, cells - most_tries) && !near.below; --n)
    if (divides_all(lengths, per / static_cast<double>(n))) near.below = n;
  for (long n = cells + 1; n <= 10 * cells + 1000 && !near.above; ++n)
    if (divides_all(lengths, per / static_cast<double>(n))) near.above = n;
  return near;
}

std::string division_error(std::string_view axis, const Face& from, const Face& to, double per,
                           long cells, const std::vector<double>& lengths) {
  const double count = (to.place - from.place) / per * static_cast<double>(cells);
  std::string text = "--foam cellsPerL: found " + std::to_string(cells) +
                     " per L = " + number_text(per) + " m, which make " +
                     number_text(std::round(count * 1e6) / 1e6) + " cells along " +
                     std::string(axis) + " from " + number_text(from.place) + " (" + from.of +
                     ") to " + number_text(to.place) + " m (" + to.of + "), expected whole cells: ";
  const NearCells near = near_cells(lengths, per, cells);
  if (!near.below && !near.above)
    return text + "no number of cells per L near divides all, so another L (--foam L=...)";
  text += "cellsPerL=";
  if (near.below) text += std::to_string(*near.below);
  if (near.below && near.above) text += " or cellsPerL=";
  if (near.above) text += std::to_string(*near.above);
  return text + ", which divide all lengths of the case";
}

}  // namespace surge::foam
