#pragma once

#include "particle/core/body_force.hpp"
#include "particle/sph/params.hpp"
#include "particle/sph/view.hpp"

namespace surge::sph {

/// Continuity, Eq. (20), with density diffusion where it is on, and the sums of XSPH, Eq. (24): one
/// pass over the pairs.
template <int D>
class DensityPass {
 public:
  explicit DensityPass(const Params& params);

  /// rate: kg/m3/s; xsph: m/s, left alone where XSPH is off. `still`: what the hydrostatic part of
  /// a density difference balances.
  void operator()(const View<D>& view, const BodyAcceleration<D>& still, Field& rate,
                  std::array<Field, D>& xsph);

 private:
  template <class K, bool Diffusion, bool Turning, bool Xsph>
  void pass(const K& kernel, const View<D>& view, const BodyAcceleration<D>& still, Field& rate,
            std::array<Field, D>& xsph);

  bool diffusion_;
  bool of_dynamic_density_;
  bool walls_too_;  ///< walls have a density by continuity
  bool xsph_;
};

}  // namespace surge::sph
