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
  using Of = typename ClusterLists<D>::Of;
  const Particles<D>& p = view.p;
  const bool moving = !wall_acceleration[0].empty();
  weights_.resize(p.size());
  std::array<const double*, D + 2> fields;
  std::array<double*, D + 2> sums;  // of W, p W and rho (x_f - x_w) W
  sums[0] = weights_.data();
  sums[1] = pressure.data();
  for (int a = 0; a < D; ++a) {
    sums_[a].resize(p.size());
    fields[a] = p.x[a].data();
    sums[2 + a] = sums_[a].data();
  }
  fields[D] = p.pressure.data();
  fields[D + 1] = p.density.data();
  const auto pair = [&](const Offset<D>& offset, const auto&, const auto& j, auto& total, auto)
                        SURGE_INLINE {
                          const Simd weight = kernel.value(offset.r);
                          total[0] += weight;
                          total[1] += weight * j[D];
                          for (int a = 0; a < D; ++a)
                            total[2 + a] += weight * j[D + 1] * offset.dx[a];
                        };
  view.lists.template sum<D + 2, D + 2, D + 2>(Of::walls, fields, sums, pair);
  view.lists.for_each(Of::walls, [&](std::size_t i) {
    Vec<D> g = still.at(p.position(i));
    double sum = pressure[i];
    for (int a = 0; a < D; ++a) {
      if (moving) g[a] -= wall_acceleration[a][i];
      sum -= g[a] * sums_[a][i];
    }
    pressure[i] = weights_[i] > 0.0 ? std::max(0.0, sum / weights_[i]) : 0.0;
    density[i] = view.model.state.density(pressure[i]);
  });
}

template <int D>
template <class K>
void WallExtrapolation<D>::velocity_pass(const K& kernel, const View<D>& view,
                                         std::array<Field, D>& shown) {
  using Of = typename ClusterLists<D>::Of;
  const Particles<D>& p = view.p;
  weights_.resize(p.size());
  std::array<const double*, 2 * D> fields;
  std::array<double*, D + 1> sums;
  for (int a = 0; a < D; ++a) {
    std::copy(p.v[a].begin(), p.v[a].end(), shown[a].begin());
    fields[a] = p.x[a].data();
    fields[D + a] = p.v[a].data();
    sums[a] = shown[a].data();
  }
  sums[D] = weights_.data();
  const auto pair = [&](const Offset<D>& offset, const auto&, const auto& j, auto& total,
                        auto j_is_fluid) SURGE_INLINE {
    if constexpr (j_is_fluid()) {
      const Simd weight = kernel.value(offset.r);
      for (int a = 0; a < D; ++a) total[a] += weight * j[D + a];
      total[D] += weight;
    }
  };
  view.lists.template sum<2 * D, 2 * D, D + 1>(Of::walls, fields, sums, pair);
  view.lists.for_each(Of::walls, [&](std::size_t i) {
    const double total = weights_[i];
    for (int a = 0; a < D; ++a)
      shown[a][i] = total > 0.0 ? 2.0 * p.v[a][i] - shown[a][i] / total : p.v[a][i];
  });
}

template class WallExtrapolation<2>;
template class WallExtrapolation<3>;

}  // namespace surge::sph
