#pragma once

#include <hdf5.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/particle_table.hpp"

namespace surge::compare {

/// An identifier of HDF5 that is closed at its end.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t id() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// An HDF5 file, read only. Nothing outside of it is followed: no external link, no external
/// storage, no virtual data set, no filter from a plugin.
class Hdf5File {
 public:
  /// Throws surge::Error where it cannot be opened.
  explicit Hdf5File(const std::filesystem::path& file);

  struct DataSet {
    std::string name;         ///< inside the group that was asked for
    std::size_t count = 0;    ///< particles
    std::size_t columns = 1;  ///< components
    std::string type;         ///< "float64", "int32"
  };

  /// Names of the links in a group ("" is the root), in their order; of groups only where asked.
  [[nodiscard]] std::vector<std::string> members(const std::string& group, bool groups_only) const;
  [[nodiscard]] bool has_group(const std::string& group) const;
  /// A numeric data set with one or two dimensions; empty where there is none. Its name may be a
  /// path below the group.
  [[nodiscard]] std::optional<DataSet> data_set(const std::string& group,
                                                const std::string& name) const;
  /// All of them below a group, by their paths.
  [[nodiscard]] std::vector<DataSet> data_sets(const std::string& group) const;
  /// The values of a data set as doubles, its rows one after the other.
  [[nodiscard]] std::vector<double> values(const std::string& group, const DataSet& set) const;
  /// The number that a data set holds alone; empty where there is none.
  [[nodiscard]] std::optional<double> number(const std::string& path) const;
  /// A number in an attribute; empty where there is none.
  [[nodiscard]] std::optional<double> attribute(const std::string& object,
                                                const std::string& name) const;

 private:
  void check_path(const std::string& path) const;
  void collect(const std::string& group, const std::string& inside, int depth,
               std::vector<DataSet>& sets) const;

  std::filesystem::path path_;
  Hdf5Handle file_;
};

/// The groups that a pattern stands for in a file: the text for its `*` (empty where it has none)
/// in the order of the numbers in them.
[[nodiscard]] std::vector<std::string> stars_of(const Hdf5File& file, const std::string& pattern);

/// The pattern with its `*` replaced.
[[nodiscard]] std::string group_of(const std::string& pattern, const std::string& star);

}  // namespace surge::compare
