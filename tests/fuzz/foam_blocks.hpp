#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/read/foam_data.hpp"

namespace surge::fuzz {

/// The blocks of a collated file, or a file that is one block.
inline std::vector<compare::FoamBlock> blocks_of(std::string_view text, const std::string& place) {
  if (text.find("decomposedBlockData") == std::string_view::npos) return {{text, {}}};
  return compare::foam_blocks(text, place);
}

}  // namespace surge::fuzz
