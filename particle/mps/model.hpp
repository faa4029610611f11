#pragma once

#include "particle/case/case.hpp"
#include "particle/mps/free_surface.hpp"
#include "particle/mps/params.hpp"

namespace surge::mps {

/// The numbers of a case and its options that do not change during a run.
template <int D>
struct Model {
  Model(const Case& c, const Params& params);

  double spacing;           ///< m
  double rho;               ///< kg/m3
  double nu;                ///< m2/s
  bool no_slip;             ///< walls that rub: only with viscosity
  double re;                ///< of gradient and number density, m
  double re_laplacian;      ///< m
  double n0;                ///< Eq. (9), at re
  double laplacian_factor;  ///< of the pressure equation, 1/m2
  double viscous_lambda;    ///< m2; the lattice's, whatever the pressure equation has
  double viscous_factor;    ///< of the viscous term, 1/m2
  double divergence_time;   ///< to take old divergence back, s
  LayerThickness<D> layer_thickness;
};

}  // namespace surge::mps
