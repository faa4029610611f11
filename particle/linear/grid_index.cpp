#include "particle/linear/grid_index.hpp"

namespace surge::linear {

template <int D>
void GridIndex<D>::reset(const Coordinate& extent, const std::array<bool, D>& wrapped) {
  extent_ = extent;
  wrapped_ = wrapped;
  std::size_t size = 1;
  for (const std::int32_t e : extent) size *= static_cast<std::size_t>(e);
  number_.assign(size, -1);
  points_.clear();
}

template <int D>
bool GridIndex<D>::wrap(Coordinate& c) const {
  for (std::size_t a = 0; a < D; ++a) {
    if (wrapped_[a]) {
      c[a] %= extent_[a];
      if (c[a] < 0) c[a] += extent_[a];
    } else if (c[a] < 0 || c[a] >= extent_[a]) {
      return false;
    }
  }
  return true;
}

template <int D>
std::size_t GridIndex<D>::offset(const Coordinate& c) const {
  std::size_t at = 0;
  for (std::size_t a = D; a-- > 0;) {
    at = at * static_cast<std::size_t>(extent_[a]) + static_cast<std::size_t>(c[a]);
  }
  return at;
}

template <int D>
std::int32_t GridIndex<D>::add(Coordinate c) {
  if (!wrap(c)) return -1;
  std::int32_t& number = number_[offset(c)];
  if (number < 0) {
    number = static_cast<std::int32_t>(points_.size());
    points_.push_back(c);
  }
  return number;
}

template <int D>
std::int32_t GridIndex<D>::find(Coordinate c) const {
  return wrap(c) ? number_[offset(c)] : -1;
}

template class GridIndex<2>;
template class GridIndex<3>;

}  // namespace surge::linear
