#include "particle/mps/viscosity.hpp"

#include "particle/core/parallel_for.hpp"
#include "particle/core/resolve.hpp"
#include "particle/mps/laplacian.hpp"

namespace surge::mps {

template <int D>
void Viscosity<D>::add(const View<D>& view, double nu, double dt, std::array<Field, D>& v) {
  for (int a = 0; a < D; ++a) shown_[a].assign(v[a].begin(), v[a].end());
  if (view.model.no_slip) extrapolate_to_walls(view);
  const double factor = nu * view.model.viscous_factor;
  const double re = view.model.re_laplacian;
  const bool deformation = term_ == ViscousTerm::deformation;
  resolve(view.model.no_slip, [&](auto no_slip) {
    const auto counts = [&](std::size_t j) { return no_slip() || view.is_fluid(j); };
    resolve(deformation, [&](auto by_deformation) {
      view.for_each_fluid([&](std::size_t i) {
        Vec<D> sum{};
        if constexpr (by_deformation()) {
          sum = deformation_sum<D>(i, view.neighbours(i), view.displacement, re, shown_, counts);
        } else {
          for (int a = 0; a < D; ++a)
            sum[a] = laplacian_sum<D>(
                i, view.neighbours(i), view.displacement, re,
                [&](std::size_t j) { return shown_[a][j]; }, counts);
        }
        for (double& component : sum) component *= factor;
        for (int a = 0; a < D; ++a) v[a][i] += dt * sum[a];
      });
    });
  });
}

/// A no-slip wall shows the fluid its own velocity, mirrored, so that the fluid has the wall's on
/// the wall's surface: v_w = 2 v_wall - sum_f v_f w / sum_f w (Adami, Hu & Adams 2012, J. Comput.
/// Phys. 231, with the weights of MPS).
template <int D>
void Viscosity<D>::extrapolate_to_walls(const View<D>& view) {
  const Particles<D>& p = view.p;
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  parallel_for(n, 256, [&](std::ptrdiff_t k) {
    const auto i = static_cast<std::size_t>(k);
    if (view.is_fluid(i)) return;
    Vec<D> sum{};
    double weights = 0.0;
    for (const std::uint32_t j : view.neighbours(i)) {
      if (!view.is_fluid(j)) continue;
      const double weight =
          mps_weight(std::sqrt(squared_norm<D>(view.displacement(i, j))), view.model.re_laplacian);
      weights += weight;
      for (int a = 0; a < D; ++a) sum[a] += weight * p.v[a][j];
    }
    for (int a = 0; a < D; ++a)
      shown_[a][i] = weights > 0.0 ? 2.0 * p.v[a][i] - sum[a] / weights : p.v[a][i];
  });
}

template class Viscosity<2>;
template class Viscosity<3>;

}  // namespace surge::mps
