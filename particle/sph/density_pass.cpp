#include "particle/sph/density_pass.hpp"

#include <algorithm>

#include "particle/sph/continuity.hpp"
#include "particle/sph/xsph.hpp"

namespace surge::sph {

template <int D>
DensityPass<D>::DensityPass(const Params& params)
    : diffusion_(params.density_diffusion > 0.0),
      of_dynamic_density_(params.diffusion_of == DiffusionOf::dynamic_density),
      walls_too_(params.wall_density == WallDensity::continuity),
      xsph_(params.xsph_epsilon > 0.0) {}

template <int D>
void DensityPass<D>::operator()(const View<D>& view, const BodyAcceleration<D>& still, Field& rate,
                                std::array<Field, D>& xsph) {
  const auto choose = [&](const auto& kernel, auto xsph_on) {
    using K = std::decay_t<decltype(kernel)>;
    constexpr bool on = decltype(xsph_on)::value;
    if (!diffusion_)
      pass<K, false, false, on>(kernel, view, still, rate, xsph);
    else if (!of_dynamic_density_)  // the hydrostatic part counts as well
      pass<K, true, false, on>(kernel, view, {}, rate, xsph);
    else if (!still.turns)
      pass<K, true, false, on>(kernel, view, still, rate, xsph);
    else
      pass<K, true, true, on>(kernel, view, still, rate, xsph);
  };
  std::visit(
      [&](const auto& kernel) {
        if (xsph_)
          choose(kernel, std::true_type{});
        else
          choose(kernel, std::false_type{});
      },
      view.model.kernel);
}

template <int D>
template <class K, bool Diffusion, bool Turning, bool Xsph>
void DensityPass<D>::pass(const K& kernel, const View<D>& view, const BodyAcceleration<D>& still,
                          Field& rate, std::array<Field, D>& xsph) {
  using Of = typename ClusterLists<D>::Of;
  const Particles<D>& p = view.p;
  const Model<D>& m = view.model;
  // x, v, the volume, the density: as many of them as are read.
  constexpr int read = Diffusion ? 2 * D + 2 : Xsph ? 2 * D + 1 : 2 * D;
  constexpr int r = Xsph ? D : 0;  // where the rate is among the sums
  const std::array<const double*, 2> more{view.fluid_volume.data(), p.density.data()};
  std::array<const double*, read> fields;
  std::array<double*, r + 1> sums;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    fields[D + a] = p.v[a].data();
    if constexpr (Xsph) sums[a] = xsph[a].data();
  }
  for (int k = 2 * D; k < read; ++k) fields[k] = more[k - 2 * D];
  sums[r] = rate.data();
  const double mass = m.mass;
  const double diffusion = m.diffusion;
  const double rho0 = m.rho0;
  const double c0 = m.c0;
  const double gamma = m.gamma;
  const Vec<D> uniform = still.uniform;

  const auto pair = [&](const Offset<D>& offset, const auto& i, const auto& j, auto& total,
                        auto j_is_fluid) SURGE_INLINE {
    const auto& dx = offset.dx;
    std::array<Simd, D> dv;
    for (int a = 0; a < D; ++a) dv[a] = j[D + a] - i[D + a];
    const Simd slope = kernel.slope(offset.r);
    total[r] += Simd(mass) * continuity<Simd, D>(dv, dx, slope);
    if constexpr (j_is_fluid()) {  // walls neither carry along nor give or take
      if constexpr (Xsph) {
        const Simd weight = xsph_weight(j[2 * D], kernel.value(offset.r));
        for (int a = 0; a < D; ++a) total[a] += weight * dv[a];
      }
      if constexpr (Diffusion) {
        const Simd rho_i = i[2 * D + 1];
        const Simd rho_j = j[2 * D + 1];
        Simd head = 0.0;
        for (int a = 0; a < D; ++a) {
          Simd g = uniform[a];
          if constexpr (Turning) {
            // What differs from place to place is taken half-way.
            for (int b = 0; b < D; ++b)
              g += Simd(still.gradient[a][b]) * (i[b] + Simd(0.5) * dx[b] - Simd(still.centre[b]));
          }
          head += g * dx[a];
        }
        const Simd at_rest =
            hydrostatic_difference<Simd>(head, Simd(0.5) * (rho_i + rho_j), rho0, c0, gamma);
        total[r] +=
            Simd(diffusion) * density_diffusion<Simd>(rho_j - rho_i - at_rest, j[2 * D], slope);
      }
    }
  };
  view.lists.template sum<read, read, r + 1>(Of::fluid, fields, sums, pair);
  if (!walls_too_) return;
  const auto without_diffusion = [&](const Offset<D>& offset, const auto& i, const auto& j,
                                     auto& total, auto) SURGE_INLINE {
    std::array<Simd, D> dv;
    for (int a = 0; a < D; ++a) dv[a] = j[D + a] - i[D + a];
    total[0] += Simd(mass) * continuity<Simd, D>(dv, offset.dx, kernel.slope(offset.r));
  };
  std::array<const double*, 2 * D> motion;
  std::copy_n(fields.begin(), 2 * D, motion.begin());
  view.lists.template sum<2 * D, 2 * D, 1>(Of::walls, motion, {rate.data()}, without_diffusion);
}

template class DensityPass<2>;
template class DensityPass<3>;

}  // namespace surge::sph
