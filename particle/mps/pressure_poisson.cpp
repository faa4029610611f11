#include "particle/mps/pressure_poisson.hpp"

#include <algorithm>
#include <cmath>

namespace surge::mps {

template <int D>
const linear::PoissonSystem& PoissonAssembly<D>::assemble(
    const Particles<D>& p, const NeighbourList<D>& list, const Displacement<D>& displacement,
    const AlignedVector<std::int32_t>& unknown, std::size_t unknowns, const Vec<D>& slope) {
  system_.row_start.resize(unknowns + 1);
  system_.diagonal.resize(unknowns);
  system_.rhs.resize(unknowns);
  for (int a = 0; a < D; ++a) system_.x[a].resize(unknowns);

  loop_.each(p.size(), [&](std::size_t i) {
    if (unknown[i] < 0) return;
    std::int32_t entries = 0;
    for (const std::uint32_t j : list.of(i)) entries += unknown[j] >= 0 && couples(p, i, j) ? 1 : 0;
    system_.row_start[static_cast<std::size_t>(unknown[i]) + 1] = entries;
  });
  const auto entries = static_cast<std::size_t>(prefix_sums_(
      unknowns, [&](std::size_t k) { return system_.row_start[k + 1]; }, system_.row_start.data()));
  system_.column.resize(entries);
  system_.value.resize(entries);

  loop_.each(p.size(), [&](std::size_t i) {
    if (unknown[i] < 0) return;
    const auto row = static_cast<std::size_t>(unknown[i]);
    auto entry = static_cast<std::size_t>(system_.row_start[row]);
    double diagonal = 0.0;
    double known = 0.0;
    const auto neighbours = list.of(i);
    std::size_t first = 0;
    for_each_lanes<D>(i, neighbours, displacement,
                      [&](const LaneIndices&, const std::array<Simd, D>& d, Simd r2) SURGE_INLINE {
                        const Simd weights = coupling(r2);
                        Simd head = slope[0] * d[0];
                        for (int a = 1; a < D; ++a) head += slope[a] * d[a];
                        head *= weights;
                        const std::size_t count = std::min(simd_width, neighbours.size() - first);
                        for (std::size_t k = 0; k < count; ++k) {
                          const std::uint32_t j = neighbours[first + k];
                          if (!couples(p, i, j)) continue;
                          const double weight = weights[k];
                          diagonal += weight;
                          known -= head[k];
                          if (unknown[j] < 0) {
                            known += weight * p.pressure[j];
                            continue;
                          }
                          system_.column[entry] = unknown[j];
                          system_.value[entry] = -static_cast<float>(weight);
                          ++entry;
                        }
                        first += simd_width;
                      });
    system_.diagonal[row] = diagonal;
    system_.rhs[row] = known;
    for (int a = 0; a < D; ++a) system_.x[a][row] = p.x[a][i];
  });
  return system_;
}

template class PoissonAssembly<2>;
template class PoissonAssembly<3>;

}  // namespace surge::mps
