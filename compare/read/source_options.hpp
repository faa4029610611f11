#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/read/physics.hpp"
#include "compare/read/units.hpp"

namespace surge {
class TomlTable;
}

namespace surge::compare {

/// Which values of a whole-numbered array mean fluid: "3", "1,2", "1-3".
class TypeValues {
 public:
  TypeValues(long value) : ranges_{{value, value}} {}  // NOLINT(google-explicit-constructor)
  /// Words such as "3" or "1-3". Throws surge::Error with `place`.
  static TypeValues parse(std::span<const std::string> words, const std::string& place);

  /// False for what is not a whole number.
  [[nodiscard]] bool contain(double value) const;
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::pair<long, long>> ranges_;
};

/// How a file's axes become those of a frame: along the surge, up, and across. A frame's `a`-th
/// coordinate is sign[a] times the file's axis[a]-th one.
struct FileAxes {
  std::array<std::size_t, 3> axis{0, 1, 2};
  std::array<double, 3> sign{1.0, 1.0, 1.0};

  /// From the axis of the surge and the one that points up, such as "-x" and "z"; the third one
  /// follows so that the system stays right-handed. Throws surge::Error with `place`.
  static FileAxes parse(std::span<const std::string> words, const std::string& place);

  [[nodiscard]] Vec3 apply(const Vec3& x) const {
    // A zero keeps no sign, so that a plane stays one.
    return {sign[0] * x[axis[0]] + 0.0, sign[1] * x[axis[1]] + 0.0, sign[2] * x[axis[2]] + 0.0};
  }
  [[nodiscard]] std::string text() const;  ///< "x, z"
};

/// Factors from a file's units to m, s, m/s and Pa.
struct FileUnits {
  double length = 1.0;
  double time = 1.0;
  std::optional<double> velocity;  ///< length / time where it is not stated
  double pressure = 1.0;

  [[nodiscard]] double speed() const { return velocity.value_or(length / time); }
};

/// What the user says about a source that its files do not say, or say under other names. Each
/// belongs to one key of a map file and to the command-line option of that name (see
/// source_keys()). Numbers are in m, s, m/s2 and kg/m3, whatever the files' units are.
struct SourceOptions {
  std::optional<Metres> column_width;
  std::optional<Metres> column_height;
  std::optional<double> gravity;      ///< magnitude, m/s2
  std::optional<Metres> tank_width;   ///< far wall from the column's wall
  std::optional<Metres> tank_height;  ///< top of the tank from its floor
  std::optional<Metres> bed_depth;    ///< of water lying in the tank at time 0
  std::optional<double> density;      ///< of the water, kg/m3
  std::optional<Metres> spacing;      ///< l0
  std::optional<Seconds> time_step;   ///< from one number of a file (or step of a dump) to the next
  std::optional<Seconds> first_time;  ///< of the first file, instead of its number times time_step
  std::optional<int> dimension;
  int vertical_axis = 1;            ///< of the files, for sources that do not say
  bool vertical_stated = false;     ///< --vertical was given
  std::optional<FileAxes> axes;     ///< instead of vertical_axis
  FileUnits units;                  ///< of the files
  std::string format;               ///< "vtk", "csv", "hdf5", "lammps"; empty: by the file itself
  std::vector<std::string> files;   ///< patterns of the fluid's files inside the source's folder
  std::vector<std::string> walls;   ///< patterns of files that are left out
  std::vector<std::string> groups;  ///< of an HDF5 file, with the fluid; `*` stands for the times
  std::vector<std::string> position_array;  ///< one vector or the components; empty: as usual
  std::vector<std::string> velocity_array{"velocity"};  ///< the same
  std::string pressure_array = "pressure";
  std::string type_array = "type";
  bool type_required = false;  ///< set for our own runs and by type_array; else all are fluid
  bool time_stated = false;    ///< set for our own runs: each frame's file states its time
  std::optional<TypeValues> fluid_type;
  bool all_fluid = false;           ///< fluid_type = "all": no array tells fluid from walls
  std::string time_array;           ///< column, attribute or field data that holds the time
  std::filesystem::path time_file;  ///< CSV: number (or step) and time of each frame
  std::string alpha_array = "alpha.water";
  /// What was set so far, as it was said: words by key. A file's name is its path.
  std::map<std::string, std::vector<std::string>> stated;
};

/// A key of a map file, which is also a command-line option with `-` for `_`.
struct SourceKey {
  std::string name;
  std::string help;
  bool list = false;  ///< several words, on the command line separated by commas
};
[[nodiscard]] const std::vector<SourceKey>& source_keys();

/// Sets one key. `place` stands before what is wrong: `file:line: key` or `--key`. Throws
/// surge::Error for a value that cannot be; `folder` is what file names are relative to.
void set_source_option(SourceOptions& options, const std::string& key,
                       std::span<const std::string> words, const std::string& place,
                       const std::filesystem::path& folder);

/// The options of a table with the keys of source_keys() and `map`, a file of the same keys that
/// comes first. Throws surge::Error `file:line: key: found, expected`, with a suggestion for a key
/// that there is not.
[[nodiscard]] SourceOptions source_options(const TomlTable& table, SourceOptions options = {});

/// A map file.
[[nodiscard]] SourceOptions read_source_map(const std::filesystem::path& file,
                                            SourceOptions options = {});

}  // namespace surge::compare
