#pragma once

#include <string>
#include <vector>

#include "particle/support/table.hpp"

namespace surge::compare {

/// "set xrange ..." (axis "x" or "y") for the numbers in some columns of a table: gnuplot's own
/// where they differ; where all are one value, a range around it, as gnuplot has none then and
/// warns of that. Fit for a logarithmic axis too.
[[nodiscard]] std::string axis_range(const std::string& axis, const Table& table,
                                     const std::vector<std::size_t>& columns);

}  // namespace surge::compare
