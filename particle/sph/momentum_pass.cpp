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
          pass<K, true, true>(kernel, view, pressures, velocity, acceleration, difference_loop_);
        else if (viscous_)
          pass<K, true, false>(kernel, view, pressures, velocity, acceleration, viscous_loop_);
        else
          pass<K, false, false>(kernel, view, pressures, velocity, acceleration, inviscid_);
      },
      view.model.kernel);
}

template <int D>
template <class K, bool Viscous, bool Difference>
void MomentumPass<D>::pass(const K& kernel, const View<D>& view, const Pressures& pressures,
                           const std::array<Field, D>& velocity, std::array<Field, D>& acceleration,
                           Loop<Viscous, Difference>& loop) {
  const Particles<D>& p = view.p;
  typename Loop<Viscous, Difference>::Sources fields;
  typename Loop<Viscous, Difference>::Sums sums;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    sums[a] = acceleration[a].data();
  }
  fields[D] = pressures.p_over_rho2.data();
  if constexpr (Viscous) {
    for (int a = 0; a < D; ++a) fields[D + 1 + a] = velocity[a].data();
    fields[2 * D + 1] = p.density.data();
    fields[2 * D + 2] = view.fluid_volume.data();
  }
  if constexpr (Difference) fields[2 * D + 3] = pressures.own_p_over_rho2.data();
  const double h2 = view.model.h * view.model.h;
  const double mass = view.model.mass;
  const double nu = view.model.nu;
  const double alpha_c0_h = view.model.alpha_c0_h;
  const bool no_slip = view.model.no_slip;
  const Rubbing rubbing = rubbing_;

  const auto pair = [&](const auto& i, const auto& j) {
    std::array<Simd, D> dx;
    Simd r2 = tiny;
    for (int a = 0; a < D; ++a) {
      dx[a] = j[a] - i[a];
      r2 += dx[a] * dx[a];
    }
    const Simd r = root(r2);
    const Simd slope = kernel.derivative(r) / r;
    Simd factor = pressure_term(i[D], j[D], slope);
    PairTerms<D> terms;
    if constexpr (Viscous) {
      std::array<Simd, D> dv;
      Simd approach = 0.0;
      for (int a = 0; a < D; ++a) {
        dv[a] = j[D + 1 + a] - i[D + 1 + a];
        approach += dv[a] * dx[a];
      }
      // Padding has no density.
      const Simd rho_i = stdx::max(i[2 * D + 1], Simd(1e-3));
      const Simd rho_j = stdx::max(j[2 * D + 1], Simd(1e-3));
      Simd volume_i = i[2 * D + 2];
      Simd volume_j = j[2 * D + 2];
      Simd artificial =
          artificial_viscosity(approach, r2, Simd(0.5) * (rho_i + rho_j), alpha_c0_h, h2) * slope;
      // Slip walls exert no friction.
      stdx::where(volume_i * volume_j == 0.0, artificial) = 0.0;
      factor += artificial;
      const Simd pressure = Simd(mass) * factor;
      for (int a = 0; a < D; ++a) {
        terms.to_i[a] = pressure * dx[a];
        terms.to_j[a] = -terms.to_i[a];
      }
      if constexpr (Difference) {
        // Each by its own pressure: only what differs from the sum of both is left to add.
        const Simd more_to_i = Simd(mass) * (i[2 * D + 3] - i[D]) * slope;
        const Simd more_to_j = Simd(mass) * (j[2 * D + 3] - j[D]) * slope;
        for (int a = 0; a < D; ++a) {
          terms.to_i[a] += more_to_i * dx[a];
          terms.to_j[a] -= more_to_j * dx[a];
        }
      }
      if (rubbing != Rubbing::none) {
        if (no_slip) {
          volume_i = Simd(mass) / rho_i;
          volume_j = Simd(mass) / rho_j;
        }
        // What is to be multiplied with the other's volume.
        const Simd one = 1.0;
        const bool deformation = rubbing == Rubbing::deformation;
        const Simd rub = deformation ? deformation_viscosity<D>(approach, r2, slope, one, nu)
                                     : laminar_viscosity(r2, slope, one, nu, h2);
        const auto& along = deformation ? dx : dv;
        for (int a = 0; a < D; ++a) {
          terms.to_i[a] += rub * volume_j * along[a];
          terms.to_j[a] -= rub * volume_i * along[a];
        }
      }
    } else {
      factor *= Simd(mass);
      for (int a = 0; a < D; ++a) {
        terms.to_i[a] = factor * dx[a];
        terms.to_j[a] = -terms.to_i[a];
      }
    }
    return terms;
  };
  loop(
      view.grid, fields, sums, [&](std::size_t i) { return view.is_fluid(i); },
      [&](std::size_t begin, std::size_t end) { return view.any_fluid(begin, end); }, pair);
}

template class MomentumPass<2>;
template class MomentumPass<3>;

}  // namespace surge::sph
