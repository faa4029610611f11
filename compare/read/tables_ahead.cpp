#include "compare/read/tables_ahead.hpp"

#include <utility>

#include "compare/read/isolated.hpp"
#include "particle/support/error.hpp"

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 16;
constexpr std::uintmax_t most_bytes = std::uintmax_t{4}
                                      << 20U;  ///< of files; their tables are larger

/// The files of `entries` from `index` on that are read in one process.
std::vector<fs::path> files_from(const std::vector<SeriesEntry>& entries, std::size_t index,
                                 const SourceOptions& options) {
  std::vector<fs::path> files;
  std::uintmax_t bytes = 0;
  for (std::size_t i = index; i < entries.size() && files.size() < most_files; ++i) {
    if (entries[i].files.size() != 1) break;
    const fs::path& file = entries[i].files.front();
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(file, failed);
    const bool readable = !failed && fs::is_regular_file(file, failed);
    const bool xml = file.extension() == ".vtp" || file.extension() == ".vtu";
    if (!xml || !readable || format_of(file, options) != Format::vtk) break;
    bytes += size;
    if (bytes > most_bytes) break;
    files.push_back(file);
  }
  return files;
}

}  // namespace

ParticleTable TablesAhead::read(const std::vector<SeriesEntry>& entries, std::size_t index,
                                const ArrayNames& wanted, const SourceOptions& options) {
  const auto known = ahead_.find(index);
  const bool follows = last_ && index == *last_ + 1;
  last_ = index;
  if (known != ahead_.end() && wanted == wanted_) {
    ParticleTable table = std::move(known->second);
    ahead_.erase(known);
    return table;
  }
  ahead_.clear();
  wanted_ = wanted;
  const std::vector<fs::path> files =
      follows ? files_from(entries, index, options) : std::vector<fs::path>{};
  if (files.size() > 1) {
    try {
      std::vector<ParticleTable> tables =
          tables_in_child(files, [&](const fs::path& file) { return read_vtk_here(file, wanted); });
      for (std::size_t k = 1; k < tables.size(); ++k)
        ahead_.emplace(index + k, std::move(tables[k]));
      return std::move(tables.front());
    } catch (const Error&) {
      ahead_.clear();
    }
  }
  const SeriesEntry& entry = entries[index];
  return read_table(entry.files.front(), entry.part, wanted, options);
}

}  // namespace surge::compare
