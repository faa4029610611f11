#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/particle_table.hpp"
#include "compare/read/run.hpp"

class vtkStringOutputWindow;
class vtkOutputWindow;
class vtkPointSet;

namespace surge::compare {

/// While it lives, what VTK would print goes here, so that check() can make an error of it. VTK's
/// readers report a broken file in no other way that holds for all of them.
class VtkErrors {
 public:
  VtkErrors();
  VtkErrors(const VtkErrors&) = delete;
  VtkErrors& operator=(const VtkErrors&) = delete;
  ~VtkErrors();
  /// Throws surge::Error `file: message` if VTK reported an error or warned.
  void check(const std::filesystem::path& file) const;

 private:
  vtkSmartPointer<vtkStringOutputWindow> window_;
  vtkSmartPointer<vtkOutputWindow> previous_;
};

/// Files that make up one time of a series.
struct SeriesEntry {
  std::optional<Seconds> time;      ///< as a collection (.pvd) gives it
  std::optional<long long> number;  ///< in the name of the file, where that orders the series
  std::vector<std::filesystem::path> files;
  FilePart part;        ///< of the file, where that holds many times (there is one file then)
  bool parted = false;  ///< part is known
};

/// The entries of a .pvd, a .series, of a folder of numbered files, a pattern with `*`, or of one
/// file. Throws surge::Error for files of more than one run, for a file that is named twice, and
/// for one outside of the folder of the collection that names it.
[[nodiscard]] std::vector<SeriesEntry> list_series(const std::filesystem::path& path,
                                                   const SourceOptions& options = {});

/// The files that a parallel file (.pvtu, .pvtp) is made of; any other file is itself.
[[nodiscard]] std::vector<std::filesystem::path> parallel_pieces(const std::filesystem::path& file);

/// One entry for each time in the files of `entries` that state none themselves, with what their
/// files say about the time.
[[nodiscard]] std::vector<SeriesEntry> with_parts(std::vector<SeriesEntry> entries,
                                                  const SourceOptions& options);

/// The points of a .vtp, .vtu or .vtk file with those of the named arrays that it has; with all of
/// its arrays where no names are given. Throws surge::Error where the file is cut short, holds no
/// point, or is a mesh.
[[nodiscard]] vtkSmartPointer<vtkPointSet> read_points(
    const std::filesystem::path& file, const std::optional<std::vector<std::string>>& arrays);

/// The time in a file's field data: under `name`, else TimeValue, TIME, Time or time; empty where
/// there is none.
[[nodiscard]] std::optional<Seconds> stated_time(const std::filesystem::path& file,
                                                 const std::string& name = "");

/// Reader of particle files: only the points and the arrays that are asked for are read.
[[nodiscard]] std::unique_ptr<FrameReader> open_particle_series(std::vector<SeriesEntry> entries,
                                                                const SourceOptions& options);

/// Reader of an OpenFOAM case, serial or decomposed (whichever holds more times).
[[nodiscard]] std::unique_ptr<FrameReader> open_foam_case(const std::filesystem::path& folder,
                                                          const SourceOptions& options);

/// Fills name, method, preset, spacing and physics of a run from its manifest (both programs write
/// the same keys). Throws surge::Error naming a key that is missing or of the wrong kind.
void apply_manifest(Run& run, const std::filesystem::path& file);

/// The same from the manifest's "case" alone, or from a case that no run was made of yet.
void apply_case(Run& run, const nlohmann::json& value, const std::string& place);

/// The same for an OpenFOAM case without a manifest: constant/g, constant/transportProperties, the
/// mesh and the volume fraction at time zero.
void apply_foam_case(Run& run, const SourceOptions& options);

}  // namespace surge::compare
