#pragma once

#include <cstddef>
#include <vector>

#include "compare/read/physics.hpp"

namespace surge::compare {

/// Which connected piece each particle belongs to: two particles no farther apart than
/// `linking_distance` (m) belong to the same one. The pieces are numbered from the largest to the
/// smallest; piece 0 is the main body. Cost O(N log N) for particles spread over cells of that
/// size.
struct Pieces {
  std::vector<std::size_t> piece_of;  ///< per particle
  std::vector<std::size_t> sizes;     ///< particles per piece, decreasing
};
[[nodiscard]] Pieces connected_pieces(const std::vector<Vec3>& position, double linking_distance);

}  // namespace surge::compare
