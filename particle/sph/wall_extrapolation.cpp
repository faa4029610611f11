#include "particle/sph/wall_extrapolation.hpp"

#include <algorithm>

namespace surge::sph {

template <int D>
void WallExtrapolation<D>::pressure(const View<D>& view, const BodyAcceleration<D>& still,
                                    const std::array<Field, D>& wall_acceleration, Field& pressure,
                                    Field& density) {
  std::visit(
      [&](const auto& kernel) {
        pressure_pass(kernel, view, still, wall_acceleration, pressure, density);
      },
      view.model.kernel);
}

template <int D>
void WallExtrapolation<D>::velocity(const View<D>& view, std::array<Field, D>& shown) {
  std::visit([&](const auto& kernel) { velocity_pass(kernel, view, shown); }, view.model.kernel);
}

template <int D>
template <class K>
void WallExtrapolation<D>::pressure_pass(const K& kernel, const View<D>& view,
                                         const BodyAcceleration<D>& still,
                                         const std::array<Field, D>& wall_acceleration,
                                         Field& pressure, Field& density) {
  const Particles<D>& p = view.p;
  constexpr int fields = D + 3;
  std::array<const double*, fields> source;
  for (int a = 0; a < D; ++a) source[a] = p.x[a].data();
  source[D] = p.pressure.data();
  source[D + 1] = p.density.data();
  source[D + 2] = view.fluid_volume.data();
  const bool moving = !wall_acceleration[0].empty();
  const auto body = [&](std::size_t i, const Tile<fields>& tile) {
    if (view.is_fluid(i)) return;
    std::array<Simd, D> xi;
    for (int a = 0; a < D; ++a) xi[a] = p.x[a][i];
    Vec<D> g = still.at(p.position(i));
    for (int a = 0; moving && a < D; ++a) g[a] -= wall_acceleration[a][i];
    Simd weights = 0.0;
    Simd pressures = 0.0;
    for (std::size_t j = 0; j < tile.count; j += simd_width) {
      Simd r2 = tiny;
      Simd head = 0.0;
      for (int a = 0; a < D; ++a) {
        const Simd dx = load(tile.field[a] + j) - xi[a];
        r2 += dx * dx;
        head -= Simd(g[a]) * dx;
      }
      Simd weight = kernel.value(Simd(root(r2)));
      stdx::where(load(tile.field[D + 2] + j) == 0.0, weight) = 0.0;
      weights += weight;
      pressures += weight * (load(tile.field[D] + j) + load(tile.field[D + 1] + j) * head);
    }
    const double sum = stdx::reduce(weights);
    pressure[i] = sum > 0.0 ? std::max(0.0, stdx::reduce(pressures) / sum) : 0.0;
    density[i] = view.model.state.density(pressure[i]);
  };
  pair_loop<D, fields>(
      view.grid, pressure_tiles_, source, [&](std::size_t cell) { return view.near_fluid(cell); },
      body);
}

template <int D>
template <class K>
void WallExtrapolation<D>::velocity_pass(const K& kernel, const View<D>& view,
                                         std::array<Field, D>& shown) {
  const Particles<D>& p = view.p;
  constexpr int fields = 2 * D + 1;
  std::array<const double*, fields> source;
  for (int a = 0; a < D; ++a) {
    source[a] = p.x[a].data();
    source[D + a] = p.v[a].data();
    std::copy(p.v[a].begin(), p.v[a].end(), shown[a].begin());
  }
  source[2 * D] = view.fluid_volume.data();
  const auto body = [&](std::size_t i, const Tile<fields>& tile) {
    if (view.is_fluid(i)) return;
    std::array<Simd, D> sum{};
    Simd weights = 0.0;
    for (std::size_t j = 0; j < tile.count; j += simd_width) {
      Simd r2 = tiny;
      for (int a = 0; a < D; ++a) {
        const Simd dx = load(tile.field[a] + j) - Simd(p.x[a][i]);
        r2 += dx * dx;
      }
      Simd weight = kernel.value(Simd(stdx::sqrt(r2)));
      stdx::where(load(tile.field[2 * D] + j) == 0.0, weight) = 0.0;
      weights += weight;
      for (int a = 0; a < D; ++a) sum[a] += weight * load(tile.field[D + a] + j);
    }
    const double total = stdx::reduce(weights);
    for (int a = 0; a < D; ++a)
      shown[a][i] = total > 0.0 ? 2.0 * p.v[a][i] - stdx::reduce(sum[a]) / total : p.v[a][i];
  };
  pair_loop<D, fields>(
      view.grid, velocity_tiles_, source, [&](std::size_t cell) { return view.near_fluid(cell); },
      body);
}

template class WallExtrapolation<2>;
template class WallExtrapolation<3>;

}  // namespace surge::sph
