#include "particle/mps/pressure_poisson.hpp"

#include <cmath>

namespace surge::mps {

template <int D>
const linear::PoissonSystem& PoissonAssembly<D>::assemble(
    const Particles<D>& p, const NeighbourList<D>& list, const Displacement<D>& displacement,
    const AlignedVector<std::int32_t>& unknown, std::size_t unknowns) {
  system_.row_start.resize(unknowns + 1);
  system_.diagonal.resize(unknowns);
  system_.rhs.resize(unknowns);
  for (int a = 0; a < D; ++a) system_.x[a].resize(unknowns);

  system_.row_start[0] = 0;
  loop_.each(p.size(), [&](std::size_t i) {
    if (unknown[i] < 0) return;
    std::int32_t entries = 0;
    for (const std::uint32_t j : list.of(i)) entries += unknown[j] >= 0 && couples(p, i, j) ? 1 : 0;
    system_.row_start[static_cast<std::size_t>(unknown[i]) + 1] = entries;
  });
  for (std::size_t k = 0; k < unknowns; ++k) system_.row_start[k + 1] += system_.row_start[k];
  const auto entries = static_cast<std::size_t>(system_.row_start[unknowns]);
  system_.column.resize(entries);
  system_.value.resize(entries);

  loop_.each(p.size(), [&](std::size_t i) {
    if (unknown[i] < 0) return;
    const auto row = static_cast<std::size_t>(unknown[i]);
    auto entry = static_cast<std::size_t>(system_.row_start[row]);
    double diagonal = 0.0;
    for (const std::uint32_t j : list.of(i)) {
      if (!couples(p, i, j)) continue;
      const double r = std::sqrt(squared_norm<D>(displacement(i, j)));
      const float weight = coupling(r);
      diagonal += static_cast<double>(weight);
      if (unknown[j] < 0) continue;
      system_.column[entry] = unknown[j];
      system_.value[entry] = -weight;
      ++entry;
    }
    system_.diagonal[row] = diagonal;
    for (int a = 0; a < D; ++a) system_.x[a][row] = p.x[a][i];
  });
  return system_;
}

template class PoissonAssembly<2>;
template class PoissonAssembly<3>;

}  // namespace surge::mps
