#include "particle/sph/model.hpp"

#include <cmath>

#include "particle/case/scales.hpp"
#include "particle/sph/momentum.hpp"

namespace surge::sph {
namespace {

template <int D>
AnyKernel<D> make_kernel(Kernel kernel, double h) {
  if (kernel == Kernel::wendland_c2) return WendlandC2<D>(h);
  return QuinticSpline<D>(h);
}

}  // namespace

template <int D>
Model<D>::Model(const Case& c, const Params& params)
    : spacing(c.spacing),
      rho0(c.density),
      nu(c.kinematic_viscosity),
      no_slip(c.has_tank && c.tank.wall == WallCondition::no_slip && nu > 0.0),
      h(params.h_over_l0 * c.spacing),
      c0(params.sound_speed_ratio * reference_speed(c)),
      gamma(params.gamma),
      alpha_c0_h(artificial_share<D>(params.artificial_viscosity * c0 * h, nu)),
      diffusion(params.density_diffusion * h * c0),
      damping(params.acoustic_damping * c0 * h),
      mass(c.density * std::pow(c.spacing, D)),
      kernel(make_kernel<D>(params.kernel, h)),
      state(c.density, c0, params.gamma) {}

template struct Model<2>;
template struct Model<3>;

}  // namespace surge::sph
