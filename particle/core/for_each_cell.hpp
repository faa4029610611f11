#pragma once

#include <array>

namespace surge {

/// Calls f(index) for all index tuples in [lower, upper), the first index running fastest.
template <int D, class F>
void for_each_cell(const std::array<int, D>& lower, const std::array<int, D>& upper, F&& f) {
  for (int a = 0; a < D; ++a)
    if (lower[a] >= upper[a]) return;
  std::array<int, D> k = lower;
  while (true) {
    f(k);
    int a = 0;
    while (a < D && ++k[a] == upper[a]) k[a] = lower[a], ++a;
    if (a == D) return;
  }
}

}  // namespace surge
