#pragma once

#include <array>
#include <cstddef>

namespace surge {

/// Entries of a symmetric matrix in D dimensions, row by row from the diagonal on.
template <int D>
inline constexpr std::size_t symmetric_entries = std::size_t{D} * (D + 1) / 2;

/// Smallest eigenvalue of a symmetric matrix given by these entries.
template <int D>
[[nodiscard]] double smallest_eigenvalue(const std::array<double, symmetric_entries<D>>& entries);

}  // namespace surge
