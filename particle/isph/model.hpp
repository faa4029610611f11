#pragma once

#include <variant>

#include "particle/case/case.hpp"
#include "particle/isph/params.hpp"
#include "particle/kernel/quintic_spline.hpp"
#include "particle/kernel/wendland_c2.hpp"

namespace surge::isph {

template <int D>
using AnyKernel = std::variant<WendlandC2<D>, QuinticSpline<D>>;

/// The numbers of a case and its options that do not change during a run.
template <int D>
struct Model {
  Model(const Case& c, const Params& params);

  double spacing;  ///< m
  double rho;      ///< kg/m3
  double nu;       ///< m2/s
  bool no_slip;    ///< walls that rub: only with viscosity
  double h;        ///< m
  double radius;   ///< of the kernel, m
  /// Pairs farther apart than this have no weight: the last thousandth of the radius, where the
  /// slope of the kernel is below 1e-8 of its largest, makes rows that rounding leaves singular.
  double reach2;           ///< m2
  double volume;           ///< l0^D, of every particle
  double divergence_time;  ///< to take old divergence back, s
  AnyKernel<D> kernel;
  double self_volume;  ///< V W(0)
  /// What makes the Laplacian exact for quadratic fields on the initial lattice: 1/m with
  /// m = sum V (-W'/r) x^2, which is near 1.
  double laplacian_factor;
  double mean_square;  ///< m2, of one component of a neighbour's distance on that lattice
};

}  // namespace surge::isph
