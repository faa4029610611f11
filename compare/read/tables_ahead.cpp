#include "compare/read/tables_ahead.hpp"

#include <utility>

namespace surge::compare {
namespace {

namespace fs = std::filesystem;

bool is_for_process(const SeriesEntry& entry, const SourceOptions& options) {
  if (entry.files.size() != 1) return false;
  const fs::path& file = entry.files.front();
  std::error_code failed;
  const bool xml = file.extension() == ".vtp" || file.extension() == ".vtu";
  return xml && fs::is_regular_file(file, failed) && format_of(file, options) == Format::vtk;
}

}  // namespace

ParticleTable TablesAhead::read(const std::vector<SeriesEntry>& entries, std::size_t index,
                                const ArrayNames& wanted, const SourceOptions& options) {
  const bool follows = last_ && index == *last_ + 1;
  last_ = index;
  const SeriesEntry& entry = entries[index];
  if (!is_for_process(entry, options))
    return read_table(entry.files.front(), entry.part, wanted, options);
  if (!process_) process_ = std::make_unique<ReadingProcess>();
  if (std::exchange(ahead_, {}) != index || wanted != wanted_)
    process_->ask(entry.files.front(), wanted);
  ParticleTable table = process_->answer();
  if (follows && index + 1 < entries.size() && is_for_process(entries[index + 1], options)) {
    process_->ask(entries[index + 1].files.front(), wanted);
    ahead_ = index + 1;
    wanted_ = wanted;
  }
  // What this process is now the child is too: it need not outlive the last file.
  if (follows && index + 1 == entries.size()) process_.reset();
  return table;
}

}  // namespace surge::compare
