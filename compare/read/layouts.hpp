#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/numbered_files.hpp"
#include "compare/read/source_options.hpp"

namespace surge::compare {

/// What lies at a source's path, for recognisers: its files by stem and one table of each stem.
class SourceView {
 public:
  SourceView(const std::filesystem::path& path, const SourceOptions& options);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The folder that was given, or that the files lie in.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] bool is_folder() const { return path_ == folder_; }
  [[nodiscard]] const Stems& stems() const { return stems_; }
  /// The arrays of the first file of a stem; empty where it cannot be read.
  [[nodiscard]] const ParticleTable& table(const std::string& stem) const;
  /// The first file of the first stem; empty where there is none.
  [[nodiscard]] std::filesystem::path first_file() const;
  /// The same for another folder.
  [[nodiscard]] SourceView inside(const std::string& folder) const;

 private:
  std::filesystem::path path_;
  std::filesystem::path folder_;
  SourceOptions options_;
  Stems stems_;
  mutable std::map<std::string, ParticleTable> tables_;
};

/// What a recogniser makes of a source: names and values filled in where the user stated none.
struct Layout {
  std::string program;  ///< empty where none is recognised
  std::string because;  ///< what it was recognised by
  std::filesystem::path path;
  SourceOptions options;
  std::vector<std::string> assumed;  ///< what was filled in, a few words each
  std::vector<std::string> read;     ///< facts that the program's own files state
  std::vector<std::string> hints;    ///< for what is still missing

  /// Fills a value in where it still is the usual one.
  template <class T>
  void assume(T& value, const T& usual, T found, const std::string& words) {
    if (!(value == usual)) return;
    value = std::move(found);
    assumed.push_back(words);
  }
  void assume_velocity(const std::vector<std::string>& names);
  void assume_pressure(const std::string& name);
  void assume_position(const std::vector<std::string>& names);
  /// An array that tells the fluid; of several values the first that any particle has.
  void assume_type(const ParticleTable& table, const std::string& name,
                   const std::vector<long>& fluid);
  void assume_axes(const std::string& surge, const std::string& up);
  void assume_files(const std::vector<std::string>& fluid, const std::vector<std::string>& walls);
  /// No array of the files tells fluid from walls: their names do.
  void assume_all_fluid();
  /// A line for each of what was assumed and read.
  [[nodiscard]] std::vector<std::string> notices() const;
};

/// Recognises how a program lays its files out and fills in what it always is. Files that cannot
/// be read are left to who reads them.
[[nodiscard]] Layout recognise(const std::filesystem::path& path, const SourceOptions& stated);

/// Whether a name speaks of water, or of what is not.
[[nodiscard]] bool names_fluid(const std::string& name);
[[nodiscard]] bool names_wall(const std::string& name);

// The programs; false where a source is not theirs.
bool recognise_dualsphysics(const SourceView& view, Layout& layout);
bool recognise_pysph(const SourceView& view, Layout& layout);
bool recognise_trixi(const SourceView& view, Layout& layout);
bool recognise_sphinxsys(const SourceView& view, Layout& layout);
bool recognise_splishsplash(const SourceView& view, Layout& layout);
bool recognise_mps(const SourceView& view, Layout& layout);
bool recognise_openmps(const SourceView& view, Layout& layout);
bool recognise_gadget(const SourceView& view, Layout& layout);
bool recognise_gpusph(const SourceView& view, Layout& layout);
bool recognise_aquagpusph(const SourceView& view, Layout& layout);
bool recognise_lammps(const SourceView& view, Layout& layout);
bool recognise_names(const SourceView& view, Layout& layout);

}  // namespace surge::compare
