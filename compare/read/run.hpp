#pragma once

#include <vtkSmartPointer.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compare/read/physics.hpp"
#include "compare/read/source_options.hpp"
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

enum class SourceKind { openfoam, particle_run, particle_series };

/// One source: an OpenFOAM case, a run folder of surge-particle, or any series of particle files.
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
  /// How a foreign source was read, whoever said it: the user, the files, or a guess. Facts by the
  /// name of the option that states them.
  std::map<std::string, std::string> reading{};

  [[nodiscard]] bool is_mesh() const { return kind == SourceKind::openfoam; }
};

/// The name that a run at `path` has: its folder's, or its file's for a series of files.
[[nodiscard]] std::string run_name(const std::filesystem::path& path);

/// The names of several sources. Those of one name have as many of their parents in front as make
/// them differ: "mine/out" and "theirs/out". One path twice has one name.
[[nodiscard]] std::vector<std::string> run_names(const std::vector<std::filesystem::path>& paths);

/// Opens a source and checks that it exists, has frames and says enough to compute Z/L.
/// `path` may be a run folder, an OpenFOAM case folder, a .pvd or .series file, a folder of
/// numbered particle files, a pattern such as "out/fluid_*.vtu", or one file that holds all times.
/// Throws surge::Error.
[[nodiscard]] Run open_run(const std::filesystem::path& path, const SourceOptions& options = {});

}  // namespace surge::compare
