#include "particle/sph/momentum_pass.hpp"

#include "particle/sph/momentum.hpp"

namespace surge::sph {

template <int D>
MomentumPass<D>::MomentumPass(const Params& params, const Model<D>& model)
    : difference_(params.negative_pressure == NegativePressure::difference),
      viscous_(model.alpha_c0_h > 0.0 || model.nu > 0.0),
      rubbing_(model.nu == 0.0                                   ? Rubbing::none
               : params.viscous_term == ViscousTerm::deformation ? Rubbing::deformation
                                                                 : Rubbing::laplacian) {}

template <int D>
void MomentumPass<D>::operator()(const View<D>& view, const Pressures& pressures,
                                 const std::array<Field, D>& velocity,
                                 std::array<Field, D>& acceleration) {
  std::visit(
      [&](const auto& kernel) {
        using K = std::decay_t<decltype(kernel)>;
        if (difference_)
          pass<K, true, true>(kernel, view, pressures, velocity, acceleration);
        else if (viscous_)
          pass<K, true, false>(kernel, view, pressures, velocity, acceleration);
        else
          pass<K, false, false>(kernel, view, pressures, velocity, acceleration);
      },
      view.model.kernel);
}

template <int D>
template <class K, bool Viscous, bool Difference>
void MomentumPass<D>::pass(const K& kernel, const View<D>& view, const Pressures& pressures,
                           const std::array<Field, D>& velocity,
                           std::array<Field, D>& acceleration) {
  const Particles<D>& p = view.p;
  // x, p/rho^2, v, density, and last what stands for p/rho^2 of the particle itself.
  constexpr int shown = Viscous ? 2 * D + 2 : D + 1;
  constexpr int read = shown + (Difference ? 1 : 0);
  std::array<const double*, read> fields;
  std::array<double*, D> sums;
  fields[D] = pressures.p_over_rho2.data();
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    if constexpr (Viscous) fields[D + 1 + a] = velocity[a].data();
    sums[a] = acceleration[a].data();
  }
  if constexpr (Viscous) fields[2 * D + 1] = p.density.data();
  if constexpr (Difference) fields[shown] = pressures.own_p_over_rho2.data();
  const double h2 = view.model.h * view.model.h;
  const double mass = view.model.mass;
  const double nu = view.model.nu;
  const double alpha_c0_h = view.model.alpha_c0_h;
  const bool no_slip = view.model.no_slip;
  const Rubbing rubbing = rubbing_;

  const auto pair = [&](const Offset<D>& offset, const auto& i, const auto& j, auto& total,
                        auto j_is_fluid) SURGE_INLINE {
    const auto& dx = offset.dx;
    const Simd slope = kernel.slope(offset.r);
    Simd factor = pressure_term(i[Difference ? shown : D], j[D], slope);
    if constexpr (Viscous) {
      std::array<Simd, D> dv;
      Simd approach = 0.0;
      for (int a = 0; a < D; ++a) {
        dv[a] = j[D + 1 + a] - i[D + 1 + a];
        approach += dv[a] * dx[a];
      }
      const Simd rho_i = i[2 * D + 1];
      const Simd rho_j = j[2 * D + 1];
      if constexpr (j_is_fluid())  // slip walls exert no friction
        factor += slope * artificial_viscosity(approach, offset.r2, Simd(0.5) * (rho_i + rho_j),
                                               alpha_c0_h, h2);
      if (rubbing != Rubbing::none && (j_is_fluid() || no_slip)) {
        const bool deformation = rubbing == Rubbing::deformation;
        const Simd volume_j = Simd(mass) / rho_j;
        const Simd rub = deformation
                             ? deformation_viscosity<D>(approach, offset.r2, slope, volume_j, nu)
                             : laminar_viscosity(offset.r2, slope, volume_j, nu, h2);
        for (int a = 0; a < D; ++a) total[a] += rub * (deformation ? dx[a] : dv[a]);
      }
    }
    factor *= Simd(mass);
    for (int a = 0; a < D; ++a) total[a] += factor * dx[a];
  };
  view.lists.template sum<read, shown, D>(ClusterLists<D>::Of::fluid, fields, sums, pair);
}

template class MomentumPass<2>;
template class MomentumPass<3>;

}  // namespace surge::sph
