#pragma once

#include <vtkSmartPointer.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compare/read/physics.hpp"
#include "compare/read/units.hpp"

class vtkUnstructuredGrid;

namespace surge::compare {

/// Which fields a frame carries besides the water itself; only these are read from the disk.
struct Fields {
  bool pressure = false;
  bool velocity = false;
};

/// The fluid particles of one time (walls and dummies are left out).
struct ParticleFrame {
  Seconds time;
  std::size_t nonfinite = 0;     ///< fluid particles left out because a coordinate is not finite
  std::vector<Vec3> position;    ///< m
  std::vector<double> pressure;  ///< Pa; empty unless asked for
  std::vector<Vec3> velocity;    ///< m/s; empty unless asked for
};

/// A volume-fraction field of one time on its mesh.
struct MeshFrame {
  Seconds time;
  /// Cell arrays: alpha_name, and if asked for `p` (Pa) and `U` (m/s) where the case has them.
  /// Corners that processors of a decomposed case share are separate points here.
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  std::string alpha_name;     ///< name of the cell array with the volume fraction
  std::vector<double> alpha;  ///< volume fraction of water per cell
};

using Frame = std::variant<ParticleFrame, MeshFrame>;
[[nodiscard]] Seconds time_of(const Frame& frame);

/// Reads the frames of one source; one frame in memory at a time.
class FrameReader {
 public:
  virtual ~FrameReader() = default;
  /// Increasing; never empty.
  [[nodiscard]] virtual const std::vector<Seconds>& times() const = 0;
  /// Throws surge::Error with the file's name where a frame or an array is missing or cut short.
  [[nodiscard]] virtual Frame read(std::size_t index, Fields fields) = 0;
  /// What was left out or assumed so far, one line each: times without the field, particles that
  /// are not finite. Every command prints them, every report shows them.
  [[nodiscard]] virtual std::vector<std::string> notices() const { return {}; }
};

/// Index of the frame nearest to a time; empty where none is within half a frame interval of it.
[[nodiscard]] std::optional<std::size_t> frame_near(const std::vector<Seconds>& times,
                                                    Seconds time);

/// What the user says about a source that its files do not say, or say under other names.
struct SourceOptions {
  std::optional<Metres> column_width;   ///< --column-width
  std::optional<Metres> column_height;  ///< --column-height
  std::optional<double> gravity;        ///< --gravity, magnitude, m/s2
  std::optional<Metres> tank_width;     ///< --tank-width: far wall from the column's wall
  std::optional<Metres> bed_depth;      ///< --bed-depth: of water lying in the tank at time 0
  std::optional<double> density;        ///< --density: of the water, kg/m3
  std::optional<Metres> spacing;        ///< --spacing: l0
  std::optional<Seconds> time_step;     ///< --time-step: between files that carry no time
  std::optional<int> dimension;         ///< --dimension
  int vertical_axis = 1;                ///< --vertical x|y|z, for sources that do not say
  std::string velocity_array = "velocity";
  std::string pressure_array = "pressure";
  std::string type_array = "type";
  bool type_required = false;  ///< set for our own runs and by --type-array; else all are fluid
  int fluid_type = 0;
  std::string alpha_array = "alpha.water";
};

enum class SourceKind { openfoam, particle_run, particle_series };

/// One source: an OpenFOAM case, a run folder of surge-particle, or any series of VTK particle
/// files.
struct Run {         // NOLINT(bugprone-exception-escape): what json destroys throws nothing
  std::string name;  ///< of its folder
  std::filesystem::path path;
  SourceKind kind = SourceKind::particle_run;
  std::string method;                     ///< "mps", "sph", "vof"; "particles" where not said
  std::string preset;                     ///< empty where not said
  Metres spacing;                         ///< particle spacing l0, or cell size along x
  std::optional<double> cells_per_width;  ///< VOF: cells per L
  Physics physics;
  nlohmann::json manifest;  ///< as read; null where there is none
  std::unique_ptr<FrameReader> frames;
  /// What was assumed or left out when it was opened, besides what the frames say.
  std::vector<std::string> notices;

  [[nodiscard]] bool is_mesh() const { return kind == SourceKind::openfoam; }
};

/// The name that a run at `path` has: its folder's, or its file's for a series of files.
[[nodiscard]] std::string run_name(const std::filesystem::path& path);

/// Opens a source and checks that it exists, has frames and says enough to compute Z/L.
/// `path` may be a run folder, an OpenFOAM case folder, a .pvd file, a folder of numbered
/// .vtp/.vtu/.vtk files, or a pattern such as "out/fluid_*.vtu". Throws surge::Error.
[[nodiscard]] Run open_run(const std::filesystem::path& path, const SourceOptions& options = {});

}  // namespace surge::compare
