#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "compare/read/readers.hpp"
#include "compare/read/reading_process.hpp"

namespace surge::compare {

/// Tables of the files of a series. XML files of VTK are read by a process of their own, one file
/// ahead while they are read one after the other; the fault of a file is told in its turn.
class TablesAhead {
 public:
  /// read_table() of the one file of entry `index`.
  [[nodiscard]] ParticleTable read(const std::vector<SeriesEntry>& entries, std::size_t index,
                                   const ArrayNames& wanted, const SourceOptions& options);

 private:
  std::unique_ptr<ReadingProcess> process_;
  std::optional<std::size_t> ahead_;  ///< the entry that is being read already
  ArrayNames wanted_;                 ///< of it
  std::optional<std::size_t> last_;
};

}  // namespace surge::compare
