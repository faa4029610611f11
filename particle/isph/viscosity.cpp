#include "particle/isph/viscosity.hpp"

namespace surge::isph {

template <int D>
void Viscosity<D>::add(const View<D>& view, double nu, double dt, std::array<Field, D>& v) {
  for (int a = 0; a < D; ++a) shown_[a].assign(v[a].begin(), v[a].end());
  with_kernel(view.model, [&](const auto& kernel) {
    if (view.model.no_slip) extrapolate_to_walls(view, kernel);
    const double factor = 2.0 * (D + 2) * nu * view.model.laplacian_factor;
    view.for_each_fluid([&](std::size_t i) {
      Vec<D> sum{};
      view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>& d, double r) {
        if (!view.model.no_slip && !view.is_fluid(j)) return;
        double approach = 0.0;
        for (int a = 0; a < D; ++a) approach += (shown_[a][j] - shown_[a][i]) * d[a];
        const double share = gradient_weight(view.model, kernel, r) * approach / (r * r);
        for (int a = 0; a < D; ++a) sum[a] += share * d[a];
      });
      for (int a = 0; a < D; ++a) v[a][i] += dt * factor * sum[a];
    });
  });
}

template <int D>
template <class K>
void Viscosity<D>::extrapolate_to_walls(const View<D>& view, const K& kernel) {
  view.for_each([&](std::size_t i) {
    if (view.is_fluid(i)) return;
    Vec<D> sum{};
    double weights = 0.0;
    view.for_each_neighbour(i, [&](std::size_t j, const Vec<D>&, double r) {
      if (!view.is_fluid(j)) return;
      const double weight = kernel.value(r);
      weights += weight;
      for (int a = 0; a < D; ++a) sum[a] += weight * view.p.v[a][j];
    });
    for (int a = 0; a < D; ++a)
      shown_[a][i] = weights > 0.0 ? 2.0 * view.p.v[a][i] - sum[a] / weights : view.p.v[a][i];
  });
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace surge::isph
