#include "particle/mps/model.hpp"

#include "particle/case/scales.hpp"
#include "particle/mps/laplacian.hpp"

namespace surge::mps {
namespace {

template <int D>
double factor_of(const Params& params, double lambda) {
  return laplacian_factor<D>(reference_number_density<D>(params.re_laplacian), lambda);
}

/// s; a case without a speed has no such time.
double divergence_time_of(const Params& params, const Case& c) {
  const double speed = reference_speed(c);
  return speed > 0.0 ? params.divergence_time * c.spacing / speed : 0.0;
}

}  // namespace

template <int D>
Model<D>::Model(const Case& c, const Params& params)
    : spacing(c.spacing),
      rho(c.density),
      nu(c.kinematic_viscosity),
      no_slip(nu > 0.0 && c.has_tank && c.tank.wall == WallCondition::no_slip),
      re(params.re_gradient * c.spacing),
      re_laplacian(params.re_laplacian * c.spacing),
      n0(reference_number_density<D>(params.re_gradient)),
      laplacian_factor(
          factor_of<D>(params, laplacian_lambda<D>(params.lambda, params.re_laplacian, c.spacing))),
      viscous_lambda(laplacian_lambda<D>(Lambda::lattice, params.re_laplacian, c.spacing)),
      viscous_factor(factor_of<D>(params, viscous_lambda)),
      divergence_time(divergence_time_of(params, c)),
      layer_thickness(re, c.spacing) {}

template struct Model<2>;
template struct Model<3>;

}  // namespace surge::mps
