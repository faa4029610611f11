#include "particle/sph/density_pass.hpp"

#include "particle/core/resolve.hpp"
#include "particle/sph/continuity.hpp"
#include "particle/sph/xsph.hpp"

namespace surge::sph {

template <int D>
DensityPass<D>::DensityPass(const Params& params)
    : diffusion_(params.density_diffusion > 0.0),
      of_dynamic_density_(params.diffusion_of == DiffusionOf::dynamic_density),
      walls_too_(params.wall_density == WallDensity::continuity) {}

template <int D>
void DensityPass<D>::operator()(const View<D>& view, const BodyAcceleration<D>& still, Field& rate,
                                std::array<Field, D>& xsph) {
  std::visit(
      [&](const auto& kernel) {
        using K = std::decay_t<decltype(kernel)>;
        if (!diffusion_)
          pass<K, false, false>(kernel, view, still, rate, xsph);
        else if (!of_dynamic_density_)  // the hydrostatic part counts as well
          pass<K, true, false>(kernel, view, {}, rate, xsph);
        else if (!still.turns)
          pass<K, true, false>(kernel, view, still, rate, xsph);
        else
          pass<K, true, true>(kernel, view, still, rate, xsph);
      },
      view.model.kernel);
}

template <int D>
template <class K, bool Diffusion, bool Turning>
void DensityPass<D>::pass(const K& kernel, const View<D>& view, const BodyAcceleration<D>& still,
                          Field& rate, std::array<Field, D>& xsph) {
  const Particles<D>& p = view.p;
  const Model<D>& m = view.model;
  typename Loop<Diffusion>::Sources fields;
  typename Loop<Diffusion>::Sums sums;
  for (int a = 0; a < D; ++a) {
    fields[a] = p.x[a].data();
    fields[D + a] = p.v[a].data();
    sums[a] = xsph[a].data();
  }
  fields[2 * D] = view.fluid_volume.data();
  if constexpr (Diffusion) fields[2 * D + 1] = p.density.data();
  sums[D] = rate.data();
  const double mass = m.mass;
  const double diffusion = m.diffusion;
  const double rho0 = m.rho0;
  const double c0 = m.c0;
  const double gamma = m.gamma;
  const Vec<D> uniform = still.uniform;

  const auto pair = [&](const auto& i, const auto& j) {
    std::array<Simd, D> dx;
    std::array<Simd, D> dv;
    Simd r2 = tiny;
    for (int a = 0; a < D; ++a) {
      dx[a] = j[a] - i[a];
      dv[a] = j[D + a] - i[D + a];
      r2 += dx[a] * dx[a];
    }
    const Simd r = root(r2);
    const Simd value = kernel.value(r);
    const Simd slope = kernel.derivative(r) / r;
    const Simd volume_i = i[2 * D];
    const Simd volume_j = j[2 * D];
    PairTerms<D + 1> terms;
    const Simd weight_i = xsph_weight(volume_j, value);
    const Simd weight_j = xsph_weight(volume_i, value);
    for (int a = 0; a < D; ++a) {
      terms.to_i[a] = weight_i * dv[a];
      terms.to_j[a] = -weight_j * dv[a];
    }
    const Simd compression = Simd(mass) * continuity<Simd, D>(dv, dx, slope);
    terms.to_i[D] = compression;
    terms.to_j[D] = compression;
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
      Simd diffused =
          Simd(diffusion) * density_diffusion<Simd>(rho_j - rho_i - at_rest, Simd(1.0), slope);
      // Walls have no volume here: they neither give nor take.
      stdx::where(volume_i * volume_j == 0.0, diffused) = 0.0;
      terms.to_i[D] += diffused * volume_j;
      terms.to_j[D] -= diffused * volume_i;
    }
    return terms;
  };
  const auto any_fluid = [&](std::size_t begin, std::size_t end) {
    return view.any_fluid(begin, end);
  };
  const auto run = [&](auto& loop) {
    resolve(walls_too_, [&](auto walls_too) {
      loop(
          view.grid, fields, sums, [&](std::size_t i) { return walls_too() || view.is_fluid(i); },
          any_fluid, pair);
    });
  };
  if constexpr (Diffusion)
    run(diffusing_);
  else
    run(plain_);
}

template class DensityPass<2>;
template class DensityPass<3>;

}  // namespace surge::sph
