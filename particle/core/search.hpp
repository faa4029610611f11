#pragma once

#include <array>

#include "particle/support/enum_names.hpp"

namespace surge {

/// How neighbours are found: every particle against every other, O(N^2) as in the paper, or by
/// cells, O(N).
enum class Search { all_pairs, cell_grid };

template <>
inline constexpr std::array enum_names<Search>{Named{"cell_grid", Search::cell_grid},
                                               Named{"all_pairs", Search::all_pairs}};

}  // namespace surge
