#pragma once

#include <string>
#include <vector>

#include "foam_cases/mesh.hpp"
#include "foam_cases/patches.hpp"
#include "foam_cases/text.hpp"

namespace surge::foam {

/// A moving wall that fills the tank across its direction: its face is a side of the mesh.
struct Piston {
  MovingWall wall;
  std::size_t axis = 0;
  bool water_above =
      true;               ///< water beyond its upper face along the axis, else below its lower one
  double tank_end = 0.0;  ///< m, where the tank ends behind it

  [[nodiscard]] double face() const {
    return water_above ? wall.box.upper[axis] : wall.box.lower[axis];
  }
  [[nodiscard]] std::size_t side() const { return 2 * axis + (water_above ? 0 : 1); }
};

/// All that the files of a case are written from.
struct FoamCase {
  std::string source;                 ///< name of the case file
  Case flow;                          ///< its tank begins at the faces of pistons
  std::vector<MovingWall> all_walls;  ///< that move, by the indices of the case file
  std::vector<Piston> pistons;
  Point drive{};      ///< m/s2: gravity along periodic axes; flow.gravity is the rest
  Settings settings;  ///< resolved
  Mesh mesh;
  std::vector<Patch> boundaries;
};

// Each of these writes one file, or fills what a template leaves open.
[[nodiscard]] std::string block_mesh(const FoamCase& c);
[[nodiscard]] std::string set_fields(const FoamCase& c);
/// system/setExprFieldsDict: velocities that differ within a block; empty where there are none.
[[nodiscard]] std::string set_expressions(const FoamCase& c);
/// Actions of topoSetDict that make a zone of the cells in a box.
[[nodiscard]] std::string zone_actions(const std::string& zone, const Box& box);
/// system/topoSetDict: cells of gauges and gates; empty where there are none.
[[nodiscard]] std::string topo_set(const FoamCase& c);
/// Function objects of controlDict: probes, gauges, forces.
[[nodiscard]] std::string instruments(const FoamCase& c);
/// Throws Error where two instruments would write to one place, or a force has no surface.
void check_records(const FoamCase& c);
/// Entries of boundaryField.
[[nodiscard]] std::string velocity_boundaries(const FoamCase& c);
[[nodiscard]] std::string alpha_boundaries(const FoamCase& c);
[[nodiscard]] std::string pressure_boundaries(const FoamCase& c);

/// The entry of fvOptions: the motion of the tank as a body acceleration; empty where it is at
/// rest.
[[nodiscard]] std::string tank_motion(const FoamCase& c);
/// constant/tankMotion: the table that fvOptions names.
[[nodiscard]] std::string motion_table(const FoamCase& c);
/// What is assumed about the motion, one line each.
[[nodiscard]] std::vector<std::string> motion_notes(const FoamCase& c);

/// All files of a case.
[[nodiscard]] Files case_files(const FoamCase& c);

}  // namespace surge::foam
