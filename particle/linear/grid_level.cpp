#include "particle/linear/grid_level.hpp"

#include <algorithm>
#include <limits>

namespace surge::linear {

template <int D>
void GridLevel<D>::allocate() {
  const std::size_t n = index.points().size();
  neighbour.resize(n * stencil);
  for (std::size_t i = 0; i < n; ++i) {
    std::fill_n(neighbour.begin() + static_cast<std::ptrdiff_t>(i * stencil), stencil,
                static_cast<std::int32_t>(i));
  }
  value.assign(n * stencil, 0.0F);
  diagonal.assign(n, 0.0F);
  inverse_diagonal.resize(n);
  rhs.resize(n);
  solution.resize(n);
  residual.resize(n);
  for (auto& nodes : colour) nodes.clear();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t parity = 0;
    for (std::size_t a = 0; a < D; ++a) {
      parity |= static_cast<std::size_t>(index.points()[i][a] & 1) << a;
    }
    colour[parity].push_back(static_cast<std::int32_t>(i));
  }
}

template <int D>
void GridLevel<D>::finish() {
  // A particle that has only known pressures around, just beside the corner of a cell, leaves less
  // at the opposite corner than a float holds, whose inverse would be infinite.
  constexpr float least = std::numeric_limits<float>::min();
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    inverse_diagonal[i] = diagonal[i] >= least ? 1.0F / diagonal[i] : 0.0F;
  }
}

template struct GridLevel<2>;
template struct GridLevel<3>;

}  // namespace surge::linear
