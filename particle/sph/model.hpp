#pragma once

#include <variant>

#include "particle/case/case.hpp"
#include "particle/kernel/quintic_spline.hpp"
#include "particle/kernel/wendland_c2.hpp"
#include "particle/sph/equation_of_state.hpp"
#include "particle/sph/params.hpp"

namespace surge::sph {

template <int D>
using AnyKernel = std::variant<QuinticSpline<D>, WendlandC2<D>>;

/// The numbers of a case and its options that do not change during a run.
template <int D>
struct Model {
  Model(const Case& c, const Params& params);

  double spacing;     ///< m
  double rho0;        ///< kg/m3
  double nu;          ///< m2/s
  bool no_slip;       ///< walls that rub: only with viscosity
  double h;           ///< m
  double c0;          ///< m/s
  double gamma;       ///< exponent of the equation of state
  double alpha_c0_h;  ///< of the artificial viscosity, m2/s
  double diffusion;   ///< delta h c0 of the density, m2/s
  double damping;     ///< bulk viscosity that damps sound, m2/s
  double mass;        ///< of a particle, kg (per m in 2D)
  AnyKernel<D> kernel;
  EquationOfState state;
};

}  // namespace surge::sph
