#pragma once

#include <string>
#include <vector>

#include "foam_cases/case_files.hpp"

namespace surge::foam {

/// Cells across the way of a gate, and when the gate is there.
struct GateRow {
  std::string zone;
  Box box;
  double from = 0.0;   ///< s
  double until = 0.0;  ///< s; beyond the end of the case where the gate stays
};

/// The rows of cells that a gate fills on its way. A row is blocked while its middle is inside the
/// gate. Throws Error for a gate that comes back to a row that it has left.
[[nodiscard]] std::vector<GateRow> gate_rows(const FoamCase& c, const MovingWall& wall);

/// Why a moving wall is none that cells which resist the flow can stand for; empty where it is one:
/// it moves along an axis, in its own plane, so that it pushes no water.
[[nodiscard]] std::string gate_fault(const Case& c, const MovingWall& wall);

/// Entries of topoSetDict and of fvOptions for all gates.
[[nodiscard]] std::string gate_zones(const FoamCase& c);
[[nodiscard]] std::string gate_options(const FoamCase& c);
/// constant/movingWalls: what the case says of them, for manifest.json; empty where there are none.
[[nodiscard]] std::string moving_walls(const FoamCase& c);

}  // namespace surge::foam
