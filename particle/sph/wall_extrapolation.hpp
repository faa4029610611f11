#pragma once

#include "particle/core/body_force.hpp"
#include "particle/sph/view.hpp"

namespace surge::sph {

/// What walls take from the fluid around them (Adami, Hu & Adams 2012, J. Comput. Phys. 231).
template <int D>
class WallExtrapolation {
 public:
  /// Pressure of a wall particle, with the hydrostatic difference, a_w being the wall's
  /// acceleration:
  ///   p_w = sum_f [ p_f + rho_f (g - a_w) . (x_w - x_f) ] W_wf / sum_f W_wf,
  /// and its density from the equation of state. Negative values are set to zero: walls do not
  /// suck. `still`: g, and what the tank's motion adds to it; `wall_acceleration`: m/s2, empty
  /// where no wall moves. Walls that water is not near to are left alone.
  void pressure(const View<D>& view, const BodyAcceleration<D>& still,
                const std::array<Field, D>& wall_acceleration, Field& pressure, Field& density);

  /// What a no-slip wall shows the viscous term, so that the fluid has the wall's velocity on its
  /// surface: v_w = 2 v_wall - sum_f v_f W_wf / sum_f W_wf. The fluid's is its own.
  void velocity(const View<D>& view, std::array<Field, D>& shown);

 private:
  template <class K>
  void pressure_pass(const K& kernel, const View<D>& view, const BodyAcceleration<D>& still,
                     const std::array<Field, D>& wall_acceleration, Field& pressure,
                     Field& density);
  template <class K>
  void velocity_pass(const K& kernel, const View<D>& view, std::array<Field, D>& shown);

  Field weights_;  ///< sum of W, 1/m^D
  std::array<Field, D> sums_;
};

}  // namespace surge::sph
