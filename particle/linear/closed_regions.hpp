#pragma once

#include <vector>

#include "particle/linear/poisson_system.hpp"

namespace surge::linear {

/// The unknowns of one connected part of the graph, ascending.
using Region = std::vector<std::int32_t>;

/// Finds the connected parts in which no row touches a p = 0 particle, that is, where the excess
/// is zero everywhere: there A is singular. Usually there
/// are none, and two sweeps over the graph tell.
class ClosedRegions {
 public:
  const std::vector<Region>& find(const PoissonSystem& system, const Field& excess);

 private:
  AlignedVector<char> open_;  // reached from a row that touches p = 0
  std::vector<Region> regions_;
};

/// Makes the equations of closed regions solvable and unique: subtracts the mean of the right side
/// over each region and adds to the diagonal of its first unknown, whose pressure becomes zero.
void anchor(const std::vector<Region>& regions, PoissonSystem& system, Field& excess, Field& guess);

/// Shifts the pressure of each region so that the lowest is zero.
void lift(const std::vector<Region>& regions, Field& p);

}  // namespace surge::linear
