#include "compare/read/particle_table.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "particle/support/error.hpp"
#include "particle/support/regular_file.hpp"
#include "particle/support/text.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

/// A format that is not read, and what its program can write instead.
struct Unread {
  std::string_view extension;
  std::string_view instead;
};

constexpr Unread unread[] = {
    {".bgeo", "SPlisHSPlasH's \"VTK exporter\" writes .vtk"},
    {".bi4", "DualSPHysics' PartVTK writes .vtk and .csv of it"},
    {".ibi4", "DualSPHysics' PartVTK writes .vtk and .csv of it"},
    {".obi4", "DualSPHysics' PartVTK writes .vtk and .csv of it"},
    {".plt", "SPHinXsys' BodyStatesRecordingToVtp writes .vtp"},
    {".npz", "PySPH writes .hdf5 where h5py is installed"},
    {".npy", "numpy.savetxt(file, array, delimiter=',', header='x,y') writes .csv"},
    {".mat", "MATLAB's writetable writes .csv"},
    {".vtkhdf", "ParaView saves it as .vtp"},
    {".vtm", "name its .vtp or .vtu files by a pattern"},
    {".h5part", "name it with --format hdf5 and --groups 'Step#*'"}};

/// The first bytes of a file.
std::string head_of(const fs::path& file) {
  std::array<char, 64> bytes{};
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(in.gcount())};
}

}  // namespace

void ParticleArray::add_word(const std::string& word) {
  // More distinct words than this are names of particles, which tell nothing.
  constexpr std::size_t most_words = 64;
  type = "text";
  const auto known = std::find(words.begin(), words.end(), word);
  values.push_back(static_cast<double>(known - words.begin()));
  if (known == words.end() && words.size() < most_words) words.push_back(word);
}

const ParticleArray* ParticleTable::find(const std::string& name) const {
  const auto found = std::find_if(arrays.begin(), arrays.end(),
                                  [&](const ParticleArray& array) { return array.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

void require_regular(const fs::path& file) {
  surge::require_regular(file, most_table_bytes, "a file of particles");
}

bool has_particle_name(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  for (const char* known :
       {".vtp", ".vtu", ".vtk", ".pvtp", ".pvtu", ".csv", ".tsv", ".txt", ".dat", ".prof", ".h5",
        ".hdf5", ".hdf", ".h5part", ".lammpstrj", ".dump"})
    if (extension == known) return true;
  // dump.fluid.1000
  return file.filename().string().starts_with("dump");
}

Format format_of(const fs::path& file, const SourceOptions& options) {
  require_regular(file);
  const std::string extension = lower_case(file.extension().string());
  for (const auto& [name, format] : {std::pair{"vtk", Format::vtk},
                                     {"csv", Format::csv},
                                     {"hdf5", Format::hdf5},
                                     {"lammps", Format::lammps}})
    if (options.format == name) return format;
  const std::string head = head_of(file);
  if (head.starts_with("\x89HDF")) {
    if (extension == ".vtkhdf")
      throw Error(file.string() + ": .vtkhdf is not read, ParaView saves it as .vtp");
    return Format::hdf5;
  }
  for (const auto& [known, instead] : unread)
    if (extension == known)
      throw Error(file.string() + ": " + extension + " is not read, " + std::string(instead));
  if (extension == ".vtp" || extension == ".vtu" || extension == ".vtk") return Format::vtk;
  if (head.starts_with("# vtk DataFile") || head.starts_with("<VTKFile")) return Format::vtk;
  if (head.starts_with("ITEM:")) return Format::lammps;
  if (extension == ".h5" || extension == ".hdf5" || extension == ".hdf")
    throw Error(file.string() + ": no HDF5 signature in its first bytes, is it cut short?");
  if (head.empty()) throw Error(file.string() + ": empty, particles expected");
  if (head.find('\0') != std::string::npos)
    throw Error(file.string() +
                ": binary in a format that is not known; .vtp, .vtu, .vtk, .csv, .hdf5 or a LAMMPS "
                "dump expected");
  return Format::csv;
}

std::string unread_file_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) files.push_back(entry);
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    for (const auto& [known, instead] : unread)
      if (lower_case(file.extension().string()) == known)
        return file.filename().string() + ": " + std::string(known) + " is not read, " +
               std::string(instead);
  return {};
}

std::vector<FilePart> parts_of(const fs::path& file, const SourceOptions& options) {
  switch (format_of(file, options)) {
    case Format::csv:
      return csv_parts(file, options);
    case Format::hdf5:
      return hdf5_parts(file, options);
    case Format::lammps:
      return lammps_parts(file);
    case Format::vtk:
      break;
  }
  return vtk_parts(file, options);
}

ParticleTable read_table(const fs::path& file, const FilePart& part, const ArrayNames& wanted,
                         const SourceOptions& options) {
  switch (format_of(file, options)) {
    case Format::csv:
      return read_csv(file, part, wanted);
    case Format::hdf5:
      return read_hdf5(file, part, wanted, options);
    case Format::lammps:
      return read_lammps(file, part, wanted);
    case Format::vtk:
      break;
  }
  return read_vtk(file, wanted);
}

}  // namespace surge::compare
