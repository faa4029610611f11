#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/read/source_options.hpp"

namespace surge::compare {

/// One named array of the particles of a file.
struct ParticleArray {
  std::string name;
  int components = 1;
  std::string type;                  ///< as the file stores it: "float", "int32", "text"
  std::vector<double> values;        ///< components x particles, a particle's together
  std::vector<std::string> words{};  ///< of "text": the distinct ones; the values are their places

  [[nodiscard]] bool is_text() const { return type == "text"; }
  /// Makes it a text array: one more word of the next particle.
  void add_word(const std::string& word);
};

/// The particles of one time in one file, as the file has them: its units, its axes, walls and all.
struct ParticleTable {
  std::size_t count = 0;
  std::vector<double> points;  ///< 3 x count; empty where positions are arrays like the others
  std::vector<ParticleArray> arrays;
  std::optional<double> time;      ///< that the file states beside the particles
  std::vector<std::string> notes;  ///< what is odd about the file, a line each

  [[nodiscard]] const ParticleArray* find(const std::string& name) const;
};

enum class Format { vtk, csv, hdf5, lammps };

/// One time of a file. Most files hold one; dumps, tables with a time column and HDF5 files may
/// hold many.
struct FilePart {
  std::optional<double> time;     ///< in the file's unit
  std::optional<long long> step;  ///< a dump's time step
  std::uintmax_t begin = 0;       ///< bytes of its rows in a text file
  std::uintmax_t end = 0;
  std::size_t line = 0;   ///< of the first row, from 1
  std::size_t count = 0;  ///< particles
  std::string star;       ///< what `*` in SourceOptions::groups stands for
};

/// Which array names are wanted; all of them where it is empty.
using ArrayNames = std::optional<std::vector<std::string>>;

/// The format of a file: as the options state it, else by its first bytes. Throws surge::Error for
/// a format that is not read, with the way to export one that is.
[[nodiscard]] Format format_of(const std::filesystem::path& file, const SourceOptions& options);

/// The first file of a folder in a format that is not read, with the way to export one that is;
/// empty where there is none.
[[nodiscard]] std::string unread_file_in(const std::filesystem::path& folder);

/// Whether a file's name is one that particle files have.
[[nodiscard]] bool has_particle_name(const std::filesystem::path& file);

/// The times of a file, in their order; never empty. Throws surge::Error.
[[nodiscard]] std::vector<FilePart> parts_of(const std::filesystem::path& file,
                                             const SourceOptions& options);

/// The particles of a part with the arrays that are wanted and there. Throws surge::Error where the
/// file is cut short, no particle file, or not readable.
[[nodiscard]] ParticleTable read_table(const std::filesystem::path& file, const FilePart& part,
                                       const ArrayNames& wanted, const SourceOptions& options);

/// Throws surge::Error unless it is a regular file (no pipe, no device) of a size that can be.
void require_regular(const std::filesystem::path& file);

// The formats, each in a file of its own.
[[nodiscard]] std::vector<FilePart> csv_parts(const std::filesystem::path& file,
                                              const SourceOptions& options);
[[nodiscard]] ParticleTable read_csv(const std::filesystem::path& file, const FilePart& part,
                                     const ArrayNames& wanted);
[[nodiscard]] std::vector<FilePart> lammps_parts(const std::filesystem::path& file);
[[nodiscard]] ParticleTable read_lammps(const std::filesystem::path& file, const FilePart& part,
                                        const ArrayNames& wanted);
[[nodiscard]] std::vector<FilePart> hdf5_parts(const std::filesystem::path& file,
                                               const SourceOptions& options);
[[nodiscard]] ParticleTable read_hdf5(const std::filesystem::path& file, const FilePart& part,
                                      const ArrayNames& wanted, const SourceOptions& options);
[[nodiscard]] std::vector<FilePart> vtk_parts(const std::filesystem::path& file,
                                              const SourceOptions& options);
[[nodiscard]] ParticleTable read_vtk(const std::filesystem::path& file, const ArrayNames& wanted);
/// The same in this process, which a damaged XML file may end.
[[nodiscard]] ParticleTable read_vtk_here(const std::filesystem::path& file,
                                          const ArrayNames& wanted);

}  // namespace surge::compare
