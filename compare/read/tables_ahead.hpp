#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "compare/read/readers.hpp"

namespace surge::compare {

/// Tables of the files of a series that are read one after the other. Each XML file is read in
/// another process (isolated.hpp), which costs more than reading it: so several that follow are
/// read in one. Where one of them is faulty, each is read alone, and its own fault is told in its
/// turn.
class TablesAhead {
 public:
  /// read_table() of the one file of entry `index`.
  [[nodiscard]] ParticleTable read(const std::vector<SeriesEntry>& entries, std::size_t index,
                                   const ArrayNames& wanted, const SourceOptions& options);

 private:
  std::map<std::size_t, ParticleTable> ahead_;
  ArrayNames wanted_;
  std::optional<std::size_t> last_;
};

}  // namespace surge::compare
